// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// All ids with their titles, by family.
std::string effects_list_text();

/// One entry explained to a person.
std::string effect_text(const Effect& effect);

}  // namespace trueaxis
