// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "machine/held_axes.hpp"

namespace trueaxis {

/// `compensate_exactly` with what its first step knows: where the actual tool is as commanded. Axes
/// that are held keep their change; on a machine whose linear axes do not span space, whose tip
/// needs the rotary ones, none is.
struct ExactCompensation {
  CompensatedPosition position;
  ToolPose before;
};
ExactCompensation compensate_exactly_with_before(const MachineModel& model, const ToolPose& target,
                                                 const AxisPositions& near, const Setting& setting,
                                                 const HeldAxes& held = {});

/// `compensate_by_differential` with axes that are held.
CompensatedPosition compensate_by_differential(const MachineModel& model,
                                               const AxisPositions& commanded,
                                               const Setting& setting, const HeldAxes& held);

/// The axes of `compensate_by_differential`, without the residual with them.
AxisPositions axes_by_differential(const MachineModel& model, const AxisPositions& commanded,
                                   const Setting& setting, const HeldAxes& held = {});

}  // namespace trueaxis
