// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/tool_in_part.hpp"

#include "simulate/machine/linear_axes.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_machine {
namespace {

Homogeneous homogeneous(const RigidTransform& transform) {
  Homogeneous out = translation(transform.origin_mm);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      out[row][column] = transform.rotation[row][column];
  return out;
}

}  // namespace

ToolInPart tool_in_part(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        const Setting& setting, const BesideCommand& beside) {
  const Ends at = ends(machine, errors, axes, beside.lost);
  const Homogeneous part = product(
      at.bed_from_table, product(homogeneous(setting.bed_from_program), part_on_table(errors)));
  const Homogeneous part_from_bed = inverse(part);
  Vector3 tip = tip_mm(machine, at, setting.tool_length_mm), holder = machine.tool.gauge_point_mm;
  for (std::size_t i = 0; i < 3; ++i) {
    tip[i] -= beside.part_drift_mm[i];
    holder[i] += (1.0 - setting.tool_length_mm) * machine.tool.direction[i];
  }
  // A point of the holder 1 mm above the tip says where the tool points.
  holder = transformed(at.bed_from_spindle, holder);
  ToolInPart out{transformed(part_from_bed, tip), {}};
  for (std::size_t i = 0; i < 3; ++i) holder[i] -= beside.part_drift_mm[i];
  holder = transformed(part_from_bed, holder);
  for (std::size_t i = 0; i < 3; ++i) out.direction[i] = holder[i] - out.tip_mm[i];
  return out;
}

AxisPositions axes_of_tip(const Machine& machine, const Vector3& tip_mm,
                          const AxisPositions& rotary, const Setting& setting) {
  AxisPositions axes = rotary;
  const auto off_mm = [&](const AxisPositions& at) {
    Vector3 off = tip_mm;
    const Vector3 tip = tool_in_part(machine, {}, at, setting).tip_mm;
    for (std::size_t i = 0; i < 3; ++i) off[i] -= tip[i];
    return off;
  };
  if (!follow_with_linear_axes(machine, off_mm, axes))
    throw InputError(machine.name,
                     "the linear axes cannot follow a tip in space: mode tip needs three of them");
  return axes;
}

double distance_mm(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace trueaxis::virtual_machine
