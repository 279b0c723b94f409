// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/effect.hpp"

/// The catalogue by family; texts are those of ISO terms where there is one.
namespace trueaxis::entries {

std::vector<Effect> part_roundness();  ///< forms that go around
std::vector<Effect> part_profile();    ///< forms along the axis, and of the axis
std::vector<Effect> spindle();
std::vector<Effect> slide();
std::vector<Effect> probe_geometry();
std::vector<Effect> probe_response();
std::vector<Effect> encoder_and_time();
std::vector<Effect> checks();

}  // namespace trueaxis::entries
