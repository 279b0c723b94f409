// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "nc/probing/probing.hpp"

namespace trueaxis::nc {

/// Before a pass that is read while the spindle turns, and after it; part of its own turns.
double run_in(const ProbingPass& pass, const ProbingLimits& limits);

/// @throws InputError with every reason why one of the plans cannot be driven within the limits
void expect_drivable(std::span<const ProbingPlan> plans, const ProbingLimits& limits,
                     ProbingControl control, const std::string& file);

}  // namespace trueaxis::nc
