// SPDX-License-Identifier: Apache-2.0
#include "correct/control/correction_grid.hpp"

#include <algorithm>
#include <cmath>

#include "correct/profile.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

std::size_t nodes_of_turn(double c_step_rad) {
  return static_cast<std::size_t>(std::lround(two_pi / c_step_rad)) + 1;
}

std::size_t nodes_of_length(double length_mm, double step_mm) {
  return static_cast<std::size_t>(std::ceil(std::abs(length_mm) / step_mm - 1e-9)) + 1;
}

CorrectionGrid correction_grid(const Correction& correction, double c_step_rad, double step_mm) {
  const Profile profile(correction.axis.axis, correction.target, correction.tool,
                        correction.motions);
  const auto [low, high] = std::minmax(correction.position_start_mm, correction.position_end_mm);
  CorrectionGrid grid;
  grid.angles = nodes_of_turn(c_step_rad);
  const std::size_t positions = std::max<std::size_t>(2, nodes_of_length(high - low, step_mm));
  for (std::size_t j = 0; j < positions; ++j)
    grid.position_mm.push_back(low + (high - low) * static_cast<double>(j) /
                                         static_cast<double>(positions - 1));
  grid.value_mm.resize(positions * grid.angles);
  for (std::size_t j = 0; j < positions; ++j) {
    for (std::size_t i = 0; i + 1 < grid.angles; ++i)
      grid.at(j, i) = profile.at(static_cast<double>(i) * c_step_rad, grid.position_mm[j]);
    grid.at(j, grid.angles - 1) = grid.at(j, 0);
  }
  return grid;
}

double CorrectionGrid::between(double c_rad, double at_position_mm) const {
  const double turns = c_rad / two_pi;
  const double c = (turns - std::floor(turns)) * static_cast<double>(angles - 1);
  const auto i = std::min(static_cast<std::size_t>(c), angles - 2);
  const double step =
      (position_mm.back() - position_mm.front()) / static_cast<double>(position_mm.size() - 1);
  const double p = std::clamp((at_position_mm - position_mm.front()) / step, 0.0,
                              static_cast<double>(position_mm.size() - 1));
  const auto j = std::min(static_cast<std::size_t>(p), position_mm.size() - 2);
  const double v = c - static_cast<double>(i), w = p - static_cast<double>(j);
  return (1.0 - w) * ((1.0 - v) * at(j, i) + v * at(j, i + 1)) +
         w * ((1.0 - v) * at(j + 1, i) + v * at(j + 1, i + 1));
}

}  // namespace trueaxis
