// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::entries {

std::vector<Effect> spindle();
std::vector<Effect> slide();

}  // namespace trueaxis::entries
