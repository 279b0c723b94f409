// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "nc/probing/probing.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// The passes of a scenario as a program drives them.
/// @throws InputError for a part or a set-up that no program can bring about
nc::ProbingPlan probing_plan(const virtual_lathe::Scenario& scenario);

/// The measurements of a diagnosis that a control can make alone and that tell more than what was
/// measured, the best first. Each begins with the passes measured, so that its log tells all.
std::vector<nc::ProbingPlan> probing_plans(const Diagnosis& diagnosis);

}  // namespace trueaxis::study
