// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "calibrate/estimate/problem.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::calibrate_detail {

/// Every effect of calibration.md that this machine may have, with why these rows cannot show
/// it where they cannot; then a user's own. Nothing else knows an effect by its id.
/// @param timed whether every row has its time
std::vector<MachineEffect> machine_effects(const Problem& problem, bool timed,
                                           std::span<const MachineEffect> own = {});

}  // namespace trueaxis::calibrate_detail
