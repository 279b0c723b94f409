// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/machine.hpp"

#include <algorithm>

namespace trueaxis {

const MachineAxis* Machine::find(AxisName axis) const {
  const auto found = std::ranges::find(axes, axis, &MachineAxis::name);
  return found == axes.end() ? nullptr : &*found;
}

std::size_t Machine::rotary_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(axes, is_rotary, &MachineAxis::name));
}

std::size_t Machine::linear_count() const { return axes.size() - rotary_count(); }

Setting first_setting(const Machine& machine) {
  Setting setting;
  if (machine.work_offsets.front())
    setting.bed_from_program = machine.work_offsets.front()->bed_from_program;
  setting.tool_length_mm = machine.tool.length_mm;
  return setting;
}

}  // namespace trueaxis
