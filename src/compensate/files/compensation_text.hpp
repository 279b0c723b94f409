// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// The result for a terminal.
std::string compensation_text(const ProgramCompensation& result);

/// That the new program is no better than the old one, for the refusal.
std::string worse_text(const ProgramCompensation& result, const CompensationOptions& options);

/// Which blocks cannot be reached, for the refusal.
std::string unreachable_text(const ProgramCompensation& result, const std::string& file);

}  // namespace trueaxis
