// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::entries {

std::vector<Effect> part_roundness();  ///< forms that go around
std::vector<Effect> part_profile();    ///< forms along the axis

}  // namespace trueaxis::entries
