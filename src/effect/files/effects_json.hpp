// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// Schema trueaxis.effects/1: the entries and the measurements that tell them apart. Lengths in mm,
/// angles in degrees, times in s.
std::string effects_json(const std::vector<const Effect*>& effects);

}  // namespace trueaxis
