// SPDX-License-Identifier: Apache-2.0
#include "machine/limits.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trueaxis {

double limit_slack(const MachineAxis& axis) {
  return is_rotary(axis.name) ? 1e-9 * rad_per_deg : 1e-9;
}

bool within(const MachineAxis& axis, double position) {
  const double slack = limit_slack(axis);
  return position >= axis.low - slack && position <= axis.high + slack;
}

std::string outside_limits(const Machine& machine, const AxisPositions& axes) {
  std::string text;
  for (const MachineAxis& axis : machine.axes) {
    const double position = axes[index_of(axis.name)];
    if (within(axis, position)) continue;
    const double unit = is_rotary(axis.name) ? rad_per_deg : 1.0;
    text += fmt::format("{}{} at {:.6f} {} is outside its limits {:g} to {:g}",
                        text.empty() ? "" : ", ", letter_of(axis.name), position / unit,
                        is_rotary(axis.name) ? "deg" : "mm", axis.low / unit, axis.high / unit);
  }
  return text;
}

namespace {

PositionRange known_range(const ErrorTerm& term) {
  if (!term.known_over || !term.name.component) return everywhere;
  const auto [low, high] = *term.known_over;
  const double more = 0.1 * (high - low);
  return {low - more, high + more};
}

}  // namespace

PositionRange known_range(const ErrorModel& errors, AxisName axis) {
  PositionRange range = everywhere;
  for (const ErrorTerm& term : errors.terms) {
    if (term.name.body != index_of(axis)) continue;
    const PositionRange one = known_range(term);
    range = {std::max(range.low, one.low), std::min(range.high, one.high)};
  }
  return range;
}

std::string outside_known(const ErrorModel& errors, const AxisPositions& axes) {
  for (const ErrorTerm& term : errors.terms) {
    const PositionRange range = known_range(term);
    if (term.name.body >= axis_count) continue;
    const double position = axes[term.name.body];
    if (position >= range.low && position <= range.high) continue;
    const auto [low, high] = *term.known_over;
    const auto axis = static_cast<AxisName>(term.name.body);
    const double unit = is_rotary(axis) ? rad_per_deg : 1.0;
    return fmt::format("{} at {:.6g} {} is beyond {:.6g} to {:.6g}, where its {} was measured",
                       letter_of(axis), position / unit, is_rotary(axis) ? "deg" : "mm", low / unit,
                       high / unit, to_string(term.name));
  }
  return "";
}

}  // namespace trueaxis
