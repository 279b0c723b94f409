// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/planning/planning.hpp"

namespace trueaxis {

/// Schema trueaxis.plan/1; lengths in mm, times in s.
std::string planning_json(const study::PlanningTask& task, const study::PlanningAnswer& answer,
                          const std::string& input_hash);

}  // namespace trueaxis
