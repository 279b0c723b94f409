// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/correction.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "correct/deviation.hpp"
#include "correct/margin.hpp"
#include "correct/precompensate.hpp"
#include "correct/profile.hpp"
#include "correct/spectrum.hpp"

namespace trueaxis {
namespace {

/// Eq. 111.
CorrectionRows wanted_rows(const Profile& profile) {
  const std::size_t count = profile.rows();
  CorrectionRows rows;
  rows.revolution.resize(count);
  rows.position_mm.resize(count);
  rows.c_rad.resize(count);
  rows.wanted_mm.resize(count);
  const std::size_t per_rev = static_cast<std::size_t>(profile.tool().rows_per_revolution);
  for (std::size_t i = 0; i < count; ++i) {
    rows.revolution[i] = static_cast<int>(i / per_rev);
    rows.position_mm[i] = profile.position_mm(i);
    rows.c_rad[i] = profile.c_rad(i);
    rows.wanted_mm[i] = profile.at(rows.c_rad[i], rows.position_mm[i]);
  }
  return rows;
}

}  // namespace

const char* to_string(Interpolation interpolation) {
  constexpr const char* names[] = {"not_stated", "linear", "none"};
  return names[static_cast<std::size_t>(interpolation)];
}

Axis Correction::commanded_axis() const {
  const std::complex<double> back = std::polar(std::exp(-loop.gain), -loop.lag_rad);
  const std::complex<double> place = back * std::complex(axis.axis.x_mm, axis.axis.y_mm);
  const std::complex<double> slope = back * std::complex(axis.axis.slope_x, axis.axis.slope_y);
  return {place.real(), place.imag(), slope.real(), slope.imag(), axis.axis.z_ref_mm};
}

Correction make_correction(const AxisEstimate& axis, const TargetSurface& target,
                           const ToolSetup& tool, const Actuator& actuator,
                           std::vector<RepeatingMotion> motions, const LoopResponse& loop) {
  actuator.validate();
  Correction correction;
  correction.target = target;
  correction.tool = tool;
  correction.actuator = actuator;
  correction.axis = axis;
  correction.motions = std::move(motions);
  correction.loop = loop;

  const Profile profile(correction.commanded_axis(), target, tool, correction.motions);
  correction.position_start_mm = profile.position_start_mm();
  correction.position_end_mm = profile.position_end_mm();
  correction.rows = wanted_rows(profile);
  correction.rows.command_mm = correction.rows.wanted_mm;
  correction.harmonics = table_harmonics(profile, actuator);
  correction.between_rows = between_rows(profile, tool.rows_per_revolution, Interpolation::linear);
  correction.held_rows = between_rows(profile, tool.rows_per_revolution, Interpolation::none);

  const Spectrum spectrum(profile);
  const Motion motion = motion_of(profile, tool.speed_rpm);
  if (can_precompensate(spectrum, motion, actuator))
    precompensate(spectrum, actuator, motion, correction.rows);
  correction.margin = margin_at(spectrum, profile, actuator, tool.speed_rpm);
  const double searched_rpm = max_speed_rpm(spectrum, profile, actuator);
  correction.margin.max_speed_rpm =
      correction.margin.follows
          ? std::max(std::min(searched_rpm, trusted_speed_rpm(correction.margin, tool.speed_rpm)),
                     tool.speed_rpm)
          : searched_rpm;
  if (!correction.margin.follows)
    correction.margin.remedies = {remedy(spectrum, profile, actuator, searched_rpm)};
  return correction;
}

}  // namespace trueaxis
