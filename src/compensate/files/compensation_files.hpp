// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// A file that the compensation read.
struct CompensationInput {
  std::string file, hash;
};

/// The result as JSON (schema trueaxis.compensation/1): lengths in mm, angles in degrees.
std::string compensation_json(const ProgramCompensation& result, const CompensationOptions& options,
                              const std::vector<CompensationInput>& inputs,
                              const std::vector<std::string>& remarks);

/// The result for a terminal.
std::string compensation_text(const ProgramCompensation& result,
                              const CompensationOptions& options);

/// That the new program is no better than the old one, for the refusal.
std::string worse_text(const ProgramCompensation& result, const CompensationOptions& options);

/// Which blocks cannot be reached, for the refusal.
std::string unreachable_text(const ProgramCompensation& result, const std::string& file);

/// What fits a screen of a compensated program: how far the tip is off before and after on its
/// whole path, what was changed, what does it. Lines are not broken, their text begins in column 8.
std::string compensation_screen(const ProgramCompensation& result,
                                const CompensationOptions& options);

/// A line of it: blocks, and the largest changes.
std::string changes_screen(const ProgramCompensation& result);

}  // namespace trueaxis
