// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/effect.hpp"

namespace trueaxis {

/// All ids with their titles, by family.
std::string effects_list_text();

/// One entry explained to a person.
std::string effect_text(const Effect& effect);

/// "0.1 to 5 ms", in the unit that reads without powers of ten; empty: no typical size.
std::string typical_size(const EffectParameter& parameter);

/// "at most 0.2 either way", "never negative"; empty: anything.
std::string possible_size(const EffectParameter& parameter);

/// The catalogue as docs/reference/effects.md: the measuring chain, an index, a section an effect.
std::string effects_markdown();

/// Schema trueaxis.effects/1: the entries and the measurements that tell them apart. Lengths in mm,
/// angles in degrees, times in s.
std::string effects_json(const std::vector<const Effect*>& effects);

}  // namespace trueaxis
