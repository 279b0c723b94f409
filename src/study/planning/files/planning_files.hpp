// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "study/planning/planning.hpp"

namespace trueaxis {

/// A range as it is written: "sigma_um=0.5:5", "readings_per_revolution=4:64",
/// "pass.length_mm=20:60".
/// @throws InputError that lists what may be chosen.
study::DesignVariable parse_design_variable(std::string_view text);

/// Schema trueaxis.plan/1; lengths in mm, times in s.
std::string planning_json(const study::PlanningTask& task, const study::PlanningAnswer& answer,
                          const std::string& input_hash);

/// For the terminal.
std::string planning_text(const study::PlanningTask& task, const study::PlanningAnswer& answer);

}  // namespace trueaxis
