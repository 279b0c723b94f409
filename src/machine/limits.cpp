// SPDX-License-Identifier: Apache-2.0
#include "machine/limits.hpp"

#include <fmt/format.h>

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

}  // namespace trueaxis
