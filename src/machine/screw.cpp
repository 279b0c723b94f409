// SPDX-License-Identifier: Apache-2.0
#include "machine/screw.hpp"

#include "machine/component_errors.hpp"

namespace trueaxis {
namespace {

using Eigen::Vector3d;
using rigid::Motion;
using Compiled = MachineModel::Compiled;

const Vector3d none = Vector3d::Zero();

Motion program_from_bed(const Setting& setting) {
  return rigid::motion(setting.bed_from_program).inverse();
}

/// The screw of a line's own motion, seen in `frame`.
Screw line_screw(const Motion& frame, bool rotary, const Vector3d& direction,
                 const Vector3d& point) {
  return rotary ? screw_in(frame, point, none, direction) : screw_in(frame, none, direction, none);
}

/// Location errors of an axis, to first order: its line exp(ξ′(q + δ)) against exp(ξ q).
Screw location_screw(const Motion& before, const Joint& joint, double position) {
  const Vector3d& u = joint.direction;
  if (!joint.rotary) {
    const Vector3d shift = joint.offset * u + position * joint.tilt.cross(u);
    return screw_in(before, none, shift, none);
  }
  const Eigen::Matrix3d R = rigid::turn(u, position);
  return screw_in(before, joint.point, joint.shift - R * joint.shift,
                  joint.offset * u + joint.tilt - R * joint.tilt);
}

Screw of_errors(const Motion& frame, const Joint& joint, const Vector3d& pivot,
                const ComponentErrors& errors) {
  const double sign = joint.inverted ? -1.0 : 1.0;
  return screw_in(frame, pivot, sign * errors.shift, sign * errors.rotation);
}

/// `frame` after the joint with its errors: frame · P.
Motion actual_step(const Motion& frame, const Joint& joint, const AxisPositions& axes) {
  const double position = joint.position(axes);
  if (joint.components.empty()) return joint.actual(frame, position);
  const Motion errors = component_errors(joint, position).motion(joint);
  return joint.errors_first ? joint.actual(frame * errors, position)
                            : joint.actual(frame, position) * errors;
}

/// A joint with one location error of size 1.
Joint with_unit_location(Joint joint, std::size_t direction) {
  joint.shift = joint.tilt = none;
  joint.offset = 0.0;
  const auto own = joint.axis % 3 + (joint.rotary ? 3 : 0);
  const auto along = static_cast<Eigen::Index>(direction % 3);
  if (direction == own)
    joint.offset = 1.0;
  else
    (direction < 3 ? joint.shift : joint.tilt)[along] = 1.0;
  return joint;
}

}  // namespace

Motion nominal_tool(const Compiled& machine, const AxisPositions& axes, const Setting& setting) {
  Motion frame = program_from_bed(setting);
  for (const Joint& joint : machine.joints) frame = joint.nominal(frame, joint.position(axes));
  return {frame.R, frame * machine.tip(setting)};
}

Motion actual_tool(const Compiled& machine, const AxisPositions& axes, const Setting& setting) {
  Motion frame = machine.workpiece.inverse() * program_from_bed(setting);
  for (const Joint& joint : machine.joints) frame = actual_step(frame, joint, axes);
  frame = frame * machine.spindle;
  return {frame.R, frame * machine.tip(setting)};
}

ChainEnds actual_ends(const Compiled& machine, const AxisPositions& axes) {
  Motion bed_in_workpiece;
  ChainEnds ends;
  for (std::size_t i = 0; i < machine.joints.size(); ++i) {
    Motion& frame = machine.machine.axes[i].carries_workpiece ? bed_in_workpiece : ends.tool;
    frame = actual_step(frame, machine.joints[i], axes);
  }
  ends.workpiece = bed_in_workpiece.inverse();
  ends.tool = ends.tool * machine.spindle;
  return ends;
}

ToolMotion nominal_motion(const Compiled& machine, const AxisPositions& axes,
                          const Setting& setting) {
  ToolMotion out;
  Motion frame = program_from_bed(setting);
  for (const Joint& joint : machine.joints) {
    out.axes[joint.axis] = line_screw(frame, joint.rotary, joint.direction, joint.point);
    frame = joint.nominal(frame, joint.position(axes));
  }
  out.tool = {frame.R, frame * machine.tip(setting)};
  return out;
}

ToolMotion actual_motion(const Compiled& machine, const AxisPositions& axes,
                         const Setting& setting) {
  ToolMotion out;
  Motion frame = machine.workpiece.inverse() * program_from_bed(setting);
  for (const Joint& joint : machine.joints) {
    const double position = joint.position(axes);
    const auto [errors, slopes] = component_errors_and_slopes(joint, position);
    const Motion off = errors.motion(joint);
    const Motion between = joint.errors_first ? frame * off : joint.actual(frame, position);
    const Motion &before_line = joint.errors_first ? between : frame,
                 &before_errors = joint.errors_first ? frame : between;
    Screw& screw = out.axes[joint.axis];
    screw = line_screw(before_line, joint.rotary, joint.actual_direction, joint.actual_point);
    screw += of_errors(before_errors, joint, joint.actual_pivot, slopes);
    frame = joint.errors_first ? joint.actual(between, position) : between * off;
  }
  frame = frame * machine.spindle;
  out.tool = {frame.R, frame * machine.tip(setting)};
  return out;
}

Screw linear_error_screw(const Compiled& machine, const AxisPositions& axes,
                         const Setting& setting) {
  Motion frame = program_from_bed(setting);
  Screw sum{-machine.workpiece_shift, -machine.workpiece_turn};
  for (const Joint& joint : machine.joints) {
    const double position = joint.position(axes);
    const Motion after = joint.nominal(frame, position);
    sum += location_screw(frame, joint, position);
    sum += of_errors(joint.errors_first ? frame : after, joint, joint.pivot,
                     component_errors(joint, position));
    frame = after;
  }
  sum += screw_in(frame, machine.gauge_point, machine.spindle_shift, machine.spindle_turn);
  return sum;
}

std::vector<UnitTips> unit_tips(const Compiled& machine, const AxisPositions& axes,
                                const Setting& setting) {
  std::vector<UnitTips> out(machine.joints.size() + 2, UnitTips::Zero());
  const Motion tool = nominal_tool(machine, axes, setting);
  Motion frame = program_from_bed(setting);
  const auto unit = [](std::size_t direction) {
    ComponentErrors errors;
    (direction < 3 ? errors.shift : errors.rotation) =
        Vector3d::Unit(static_cast<Eigen::Index>(direction % 3));
    return errors;
  };
  for (std::size_t k = 0; k < machine.joints.size(); ++k) {
    const Joint& joint = machine.joints[k];
    const double position = joint.position(axes);
    const Motion after = joint.nominal(frame, position);
    for (std::size_t d = 0; d < 6; ++d) {
      const auto column = static_cast<Eigen::Index>(d);
      out[k].col(column) =
          of_errors(joint.errors_first ? frame : after, joint, joint.pivot, unit(d))
              .of_point(tool.t);
      out[k].col(6 + column) =
          location_screw(frame, with_unit_location(joint, d), position).of_point(tool.t);
    }
    frame = after;
  }
  UnitTips &spindle = out[machine.joints.size()], &workpiece = out.back();
  for (std::size_t d = 0; d < 6; ++d) {
    const auto column = static_cast<Eigen::Index>(6 + d);
    const auto [shift, rotation] = unit(d);
    spindle.col(column) = screw_in(frame, machine.gauge_point, shift, rotation).of_point(tool.t);
    workpiece.col(column) = Screw{-shift, -rotation}.of_point(tool.t);
  }
  return out;
}

}  // namespace trueaxis
