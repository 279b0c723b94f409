// SPDX-License-Identifier: Apache-2.0
#include "correct/repeating_motion.hpp"

#include <array>
#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis {

double motion_mm(const RepeatingMotion& motion, double c_rad, double z_mm, double dx_dz) {
  static constexpr double zero = 0.0, one = 1.0;
  const std::span<const double> none(&zero, 1);
  TermContext at{};
  at.c_rad = {&c_rad, 1};
  at.z_mm = {&z_mm, 1};
  at.dx_dz = {&dx_dz, 1};
  at.time_s = at.speed_rad_per_s = at.velocity_mm_per_s = at.x_mm = at.sensed_mm = at.dx_dc = none;
  at.theta_rad = at.theta_chuck_rad = at.s_mm = none;
  at.clamp_force_ratio = {&one, 1};
  at.z_mid_mm = motion.z_mid_mm;
  at.z_half_mm = motion.z_half_mm;
  constexpr std::size_t most = 32;
  std::array<double, most> value{};
  std::array<double*, most> columns{};
  const std::vector<double>& linear = motion.term.linear;
  expects(linear.size() <= most, "a motion of 32 parameters or fewer");
  for (std::size_t j = 0; j < most; ++j) columns[j] = &value[j];
  fill_columns(motion.term.effect->term, at, motion.term.shape,
               std::span(columns).first(linear.size()));
  double sum = 0.0;
  for (std::size_t j = 0; j < linear.size(); ++j) sum += linear[j] * value[j];
  return sum;
}

int side_of_tool(double angle_from_probe_rad) {
  constexpr double aligned = 1.0 - 1e-6;  // 0.08°: what it leaves is 1e-6 of the motion
  const double cosine = std::cos(angle_from_probe_rad);
  return cosine > aligned ? 1 : cosine < -aligned ? -1 : 0;
}

}  // namespace trueaxis
