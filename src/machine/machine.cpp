// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "machine/algebra.hpp"

namespace trueaxis {

Matrix3 rotation_zyx(const Vector3& angles_rad) {
  using Eigen::Vector3d;
  return rigid::rows(Eigen::Matrix3d(rigid::turn(Vector3d::UnitZ(), angles_rad[2]) *
                                     rigid::turn(Vector3d::UnitY(), angles_rad[1]) *
                                     rigid::turn(Vector3d::UnitX(), angles_rad[0])));
}

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
