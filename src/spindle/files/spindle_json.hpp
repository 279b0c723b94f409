// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/spindle.hpp"

namespace trueaxis {

/// The result as JSON (schema trueaxis.spindle/1): lengths in mm, angles in degrees.
std::string spindle_json(const SpindleResult& result, const SpindleOptions& options);

}  // namespace trueaxis
