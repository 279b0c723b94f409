// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// What fits a screen of a compensated program: how far the tip is off before and after on its
/// whole path, what was changed, what does it. Lines are not broken, their text stands in column 8.
std::string compensation_screen(const ProgramCompensation& result,
                                const CompensationOptions& options);

/// A line of it: blocks, and the largest changes.
std::string changes_screen(const ProgramCompensation& result);

}  // namespace trueaxis
