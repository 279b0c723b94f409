// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis::entries {

std::vector<Effect> probe_geometry();
std::vector<Effect> probe_response();

}  // namespace trueaxis::entries
