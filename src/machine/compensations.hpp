// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// `compensate_exactly` with what its first step knows: where the actual tool is as commanded.
struct ExactCompensation {
  CompensatedPosition position;
  ToolPose before;
};
ExactCompensation compensate_exactly_with_before(const MachineModel& model, const ToolPose& target,
                                                 const AxisPositions& near, const Setting& setting);

/// The axes of `compensate_by_differential`, without what is left with them.
AxisPositions axes_by_differential(const MachineModel& model, const AxisPositions& commanded,
                                   const Setting& setting);

}  // namespace trueaxis
