// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nc/probing/probing.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// The passes of a scenario as a program drives them.
/// @throws InputError for a part or a set-up that no program can bring about
nc::ProbingPlan probing_plan(const virtual_lathe::Scenario& scenario);

}  // namespace trueaxis::study
