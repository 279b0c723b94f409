// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/planning/planning.hpp"

namespace trueaxis {

/// For the terminal.
std::string planning_text(const study::PlanningTask& task, const study::PlanningAnswer& answer);

}  // namespace trueaxis
