// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// What the virtual lathe knows, schema "trueaxis.truth/1": part, effects, noise, seed, rows of
/// outliers and clipped readings (0-based). Lengths in mm, angles in degrees, times in s, each
/// value with its unit. `half_angle` is in (0, 90°); the place of k says which way the cone opens.
std::string truth_json(const virtual_lathe::Truth& truth);

}  // namespace trueaxis
