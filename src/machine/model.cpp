// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "machine/screw.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using rigid::eigen;

/// Sum of the constants of a body's location errors (X0K, Y0K, Z0K or A0K, B0K, C0K).
Vector3d location(const ErrorModel& errors, std::size_t body, bool angular) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    sum[static_cast<Eigen::Index>(i)] =
        errors.value({false, i + (angular ? 3 : 0), body}, AxisPositions{});
  return sum;
}

/// δ, tilt and shift: K0K moves along the axis' own letter, the others move its line.
void locate(Joint& joint, const ErrorModel& errors) {
  joint.shift = location(errors, joint.axis, false);
  joint.tilt = location(errors, joint.axis, true);
  const auto own = static_cast<Eigen::Index>(joint.axis % 3);
  Vector3d& of_own = joint.rotary ? joint.tilt : joint.shift;
  joint.offset = of_own[own];
  of_own[own] = 0.0;
  joint.actual_direction = rigid::exponential(joint.tilt) * joint.direction;
  joint.actual_point = joint.point + joint.shift;
}

Joint joint_of(const MachineAxis& axis, const ErrorModel& errors) {
  Joint joint;
  joint.axis = index_of(axis.name);
  joint.rotary = is_rotary(axis.name);
  joint.errors_first = joint.rotary != axis.carries_workpiece;
  joint.inverted = axis.carries_workpiece && errors.sign == ErrorSign::moving_part;
  joint.direction = eigen(axis.direction);
  joint.point = eigen(axis.point_mm);
  locate(joint, errors);
  joint.pivot = joint.rotary ? joint.point : eigen(errors.reference_mm[joint.axis]);
  joint.actual_pivot = joint.rotary ? joint.actual_point : joint.pivot;
  for (const ErrorTerm& term : errors.terms) {
    if (!term.name.component || term.name.body != joint.axis) continue;
    joint.components.push_back({term.name.direction, term.function});
    joint.turns = joint.turns || term.name.angular();
  }
  return joint;
}

void check(const Machine& machine, const ErrorModel& errors) {
  std::vector<Diagnostic> wrong;
  for (const ErrorTerm& term : errors.terms) {
    const std::string name = to_string(term.name);
    const bool of_axis = term.name.body < axis_count;
    if (of_axis && machine.find(static_cast<AxisName>(term.name.body)) == nullptr) {
      wrong.push_back({"errors", 0, 0, name + " refers to an axis this machine does not have"});
    } else if (!term.name.component && !std::holds_alternative<ConstantError>(term.function)) {
      wrong.push_back({"errors", 0, 0, name + " is a location error: a constant"});
    } else if (without_effect(term.name) && value_at(term.function, 0.0) != 0.0) {
      wrong.push_back({"errors", 0, 0, name + " has no effect: it must be 0"});
    }
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

ToolDisplacement at_tip(const Screw& screw, const Vector3d& tip) {
  return {rigid::array(screw.of_point(tip)), rigid::array(screw.w)};
}

}  // namespace

MachineModel::MachineModel(const Machine& machine, const ErrorModel& errors) {
  check(machine, errors);
  auto compiled = std::make_shared<Compiled>();
  compiled->machine = machine;
  compiled->errors = errors;
  for (const MachineAxis& axis : machine.axes) compiled->joints.push_back(joint_of(axis, errors));
  compiled->gauge_point = eigen(machine.tool.gauge_point_mm);
  compiled->tool_direction = eigen(machine.tool.direction);
  compiled->spindle_shift = location(errors, spindle_body, false);
  compiled->spindle_turn = location(errors, spindle_body, true);
  compiled->workpiece_shift = location(errors, workpiece_body, false);
  compiled->workpiece_turn = location(errors, workpiece_body, true);
  compiled->spindle = rigid::about(
      compiled->gauge_point, rigid::exponential(compiled->spindle_turn), compiled->spindle_shift);
  compiled->workpiece = {rigid::exponential(compiled->workpiece_turn), compiled->workpiece_shift};
  compiled_ = std::move(compiled);
}

const Machine& MachineModel::machine() const { return compiled_->machine; }
const ErrorModel& MachineModel::errors() const { return compiled_->errors; }

ToolPose MachineModel::nominal(const AxisPositions& axes, const Setting& setting) const {
  return compiled_->pose(nominal_tool(*compiled_, axes, setting));
}

ToolPose MachineModel::actual(const AxisPositions& axes, const Setting& setting) const {
  return compiled_->pose(actual_tool(*compiled_, axes, setting));
}

ToolJacobian MachineModel::jacobian(const AxisPositions& axes, const Setting& setting) const {
  const ToolMotion motion = nominal_motion(*compiled_, axes, setting);
  ToolJacobian columns;
  std::ranges::transform(motion.axes, columns.begin(),
                         [&](const Screw& screw) { return at_tip(screw, motion.tool.t); });
  return columns;
}

ToolDisplacement MachineModel::linear_error(const AxisPositions& axes,
                                            const Setting& setting) const {
  return at_tip(linear_error_screw(*compiled_, axes, setting),
                nominal_tool(*compiled_, axes, setting).t);
}

}  // namespace trueaxis
