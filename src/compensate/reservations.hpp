// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nc/program.hpp"
#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// What a reader of the largest deviations must know: moves that they do not count, and a direction
/// that comes out worse.
Reasons reservations_of(const nc::Program& program, const CompensationOptions& options,
                        const ProgramCompensation& result);

}  // namespace trueaxis
