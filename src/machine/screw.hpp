// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "machine/compiled.hpp"

namespace trueaxis {

/// A velocity of a body: that of its point at the origin of the part just then, and about it.
struct Screw {
  Eigen::Vector3d v = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero();

  Screw& operator+=(const Screw& other) {
    v += other.v;
    w += other.w;
    return *this;
  }
  Eigen::Vector3d of_point(const Eigen::Vector3d& x) const { return v + w.cross(x); }
};

/// Moving by `shift` and turning by `rotation` about `point`, all seen in `frame`.
inline Screw screw_in(const rigid::Motion& frame, const Eigen::Vector3d& point,
                      const Eigen::Vector3d& shift, const Eigen::Vector3d& rotation) {
  const Eigen::Vector3d w = frame.R * rotation;
  return {frame.R * shift - w.cross(frame * point), w};
}

/// Where the tool is in the part, and the screw of every axis by `index_of` per mm or rad.
struct ToolMotion {
  rigid::Motion tool;  ///< its origin: the tip
  std::array<Screw, axis_count> axes{};

  Eigen::Vector3d direction(const MachineModel::Compiled& machine) const {
    return tool.R * machine.tool_direction;
  }
};

ToolMotion nominal_motion(const MachineModel::Compiled& machine, const AxisPositions& axes,
                          const Setting& setting);

/// With all errors, and with what they change along an axis: the derivative of `actual`, up to the
/// product of two errors.
ToolMotion actual_motion(const MachineModel::Compiled& machine, const AxisPositions& axes,
                         const Setting& setting);

rigid::Motion nominal_tool(const MachineModel::Compiled& machine, const AxisPositions& axes,
                           const Setting& setting);
rigid::Motion actual_tool(const MachineModel::Compiled& machine, const AxisPositions& axes,
                          const Setting& setting);

/// Both ends of the chain in M, with all errors: the body of the workpiece without D, and that of
/// the tool with S. A point x of a body in the zero position is at G x.
struct ChainEnds {
  rigid::Motion workpiece, tool;
};
ChainEnds actual_ends(const MachineModel::Compiled& machine, const AxisPositions& axes);

/// Displacement of the tool in the part by all errors, linear in them.
Screw linear_error_screw(const MachineModel::Compiled& machine, const AxisPositions& axes,
                         const Setting& setting);

/// What errors of 1 mm and 1 rad each do to the tip in the part, to first order: the component
/// errors EX. EY. EZ. EA. EB. EC. of a joint, then its location errors X0. … C0.
using UnitTips = Eigen::Matrix<double, 3, 12>;

/// For every joint of the chain, the spindle and the workpiece.
std::vector<UnitTips> unit_tips(const MachineModel::Compiled& machine, const AxisPositions& axes,
                                const Setting& setting);

}  // namespace trueaxis
