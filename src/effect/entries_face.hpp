// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

/// What a face shows and a lateral surface does not: its probe reads Z at (C, X).
namespace trueaxis::entries {

std::vector<Effect> part_face();
std::vector<Effect> spindle_axial();
std::vector<Effect> slide_face();

}  // namespace trueaxis::entries
