// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/machine/bodies.hpp"

namespace trueaxis::virtual_machine {

/// The tool in the frame of the program, which is fixed to the part.
struct ToolInPart {
  Vector3 tip_mm{}, direction{};  ///< unit, from the tip to the holder
};

/// How far an axis is off its command, and the part off its place, apart from the errors of the
/// machine's geometry.
struct BesideCommand {
  AxisPositions lost{};     ///< mm, rad
  Vector3 part_drift_mm{};  ///< of the part against the tip, in M
};

/// At commanded axes. @param errors no terms: the nominal machine
ToolInPart tool_in_part(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        const Setting& setting, const BesideCommand& beside = {});

/// The axes at which the nominal machine has its tip there, the rotary ones as given.
/// @throws InputError where its linear axes do not span space
AxisPositions axes_of_tip(const Machine& machine, const Vector3& tip_mm,
                          const AxisPositions& rotary, const Setting& setting);

double distance_mm(const Vector3& a, const Vector3& b);

}  // namespace trueaxis::virtual_machine
