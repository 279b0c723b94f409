// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "trueaxis/machine.hpp"

/// The virtual machine of several axes: what a measurement on it would read. Of room `machine` it
/// takes the types that say what a machine and its errors are, and no formula: the chain is here a
/// product of homogeneous matrices from the bed outwards, every body against its neighbour nearer
/// to the bed, as ISO 230-1 defines the errors.
namespace trueaxis::virtual_machine {

/// 4 × 4, by rows: x_to = matrix · (x_from, 1).
using Homogeneous = std::array<std::array<double, 4>, 4>;

Homogeneous product(const Homogeneous& left, const Homogeneous& right);
Vector3 transformed(const Homogeneous& to_from, const Vector3& point_mm);
Homogeneous translation(const Vector3& by_mm);
/// About the axis through the origin, by the right hand.
Homogeneous rotation(const Vector3& unit_axis, double angle_rad);
/// By |w| about w.
Homogeneous rotation(const Vector3& w_rad);

/// Where the two ends of the chain are in M, the frame of the bed.
struct Ends {
  Homogeneous bed_from_table;    ///< the body that carries the workpiece
  Homogeneous bed_from_spindle;  ///< with the spindle's own location errors
};

/// At commanded axes. `lost`: how far each axis is off its command, added to its own error
/// (lost motion of a reversal), mm or rad.
/// @param errors no terms: the nominal machine
Ends ends(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
          const AxisPositions& lost = {});

/// What the tool does against the workpiece in addition to the command of one axis, along or about
/// the axis' own direction: what a read-out between the two shows, mm or rad.
double own_error(const Machine& machine, const ErrorModel& errors, AxisName axis, double position);

/// How far the part on its table is from where it should be.
Homogeneous part_on_table(const ErrorModel& errors);

/// Lost motion: an axis that comes from above is too high by its reversal, and so it stays
/// until it moves again.
void take_lost_motion(const AxisPositions& reversal, const AxisPositions& from,
                      const AxisPositions& to, AxisPositions& lost);

/// The inverse of a rigid motion.
Homogeneous inverse(const Homogeneous& motion);

/// In M, of a tool of this length.
Vector3 tip_mm(const Machine& machine, const Ends& ends, double tool_length_mm);

}  // namespace trueaxis::virtual_machine
