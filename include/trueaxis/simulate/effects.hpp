// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "trueaxis/simulate/scenario.hpp"

namespace trueaxis::virtual_lathe {

/// A parameter of an effect. The unit inside is the suffix of its name; none: a pure number.
struct EffectParameter {
  std::string_view name;
  std::optional<double> fallback;  ///< absent: the scenario must give it
};

/// An effect that the virtual lathe can have.
struct EffectKind {
  std::string_view id;
  std::string_view what;  ///< its term, in one line
  std::span<const EffectParameter> parameters;
};

/// All of them, in the order of the measuring chain.
std::span<const EffectKind> effect_kinds();

/// @throws InputError listing the known ids, or the known parameters of the id.
const EffectKind& find_effect_kind(std::string_view id);

/// @throws InputError for an unknown id, an unknown or missing parameter.
void validate(const Effect& effect);

/// The parameter's value or its fallback. Expects a valid effect.
double parameter(const Effect& effect, std::string_view name);

}  // namespace trueaxis::virtual_lathe
