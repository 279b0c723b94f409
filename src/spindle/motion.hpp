// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "spindle/recording.hpp"
#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// Radial runs, or axial ones, in one estimate. @throws InputError for a layout without a solution.
ErrorMotion error_motion(std::vector<RunReadings> runs, const SpindleOptions& options,
                         std::vector<std::string>& notes);

}  // namespace trueaxis
