// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "trueaxis/effect/term.hpp"

namespace trueaxis {

/// Where an effect enters the measuring chain (C, Z, t) → A → B → C → D → E → X_M.
enum class Slot {
  arguments,   ///< A: C' = C + δC, Z' = Z + δZ
  probe_line,  ///< B: height, tilt, ball
  part,        ///< C: the part's surface, along its normal
  machine,     ///< D: added to X
  sensor,      ///< E: response
  noise        ///< ε
};

/// What an effect is fixed to: it decides what re-chucking, reversal, another speed or a return
/// pass does to it.
enum class Frame { part, chuck, spindle, machine, probe, time };

/// A parameter with the sizes that machines show: priors, not limits. Both 0: no typical size.
struct EffectParameter {
  std::string_view name;
  std::string_view unit;  ///< mm, rad, s, Hz, 1 and quotients of them
  double low = 0.0, high = 0.0;
  std::string_view meaning;
};

/// A measurement that tells causes apart.
struct Separator {
  std::string_view code, what;
};

/// How a measurement separates this effect from its confounders.
struct Separation {
  std::string_view code, how;
};

/// Largest shift of the identified axis over Z when the effect is left out, per unit of its
/// parameter; R = 40 mm, tan α = 0.1, e = 0.2 mm, tilt 1 mrad, Z 0-60 mm. Depends on the plan.
struct Harm {
  double value = 0.0;
  std::string_view unit, text;
};

/// An entry of the catalogue: data that the engine, the report and the command line read.
struct Effect {
  std::string_view id = {};
  std::string_view title = {};
  Slot slot = Slot::part;
  Frame frame = Frame::part;
  Term term = {};                 ///< how it is computed; monostate for a check
  std::string_view formula = {};  ///< the term as text
  std::vector<EffectParameter> parameters = {};
  std::string_view signature = {};
  std::vector<std::string_view> confounders = {};  ///< ids
  std::string_view absorbed_by = {};               ///< parameters of the surface that take it in
  std::vector<Separation> separations = {};
  std::optional<Harm> harm = {};
  std::string_view source = {};
  bool check = false;  ///< quality of the data: handled and reported, never a name for a form
};

/// All effects and checks, family by family.
std::span<const Effect> effect_catalogue();

/// nullptr when there is none with this id.
const Effect* find_effect(std::string_view id);

/// The known ids most like a misspelt one, best first.
std::vector<std::string_view> nearest_effects(std::string_view id, std::size_t count = 3);

std::span<const Separator> separators();

std::string_view to_string(Slot slot);
std::string_view to_string(Frame frame);

}  // namespace trueaxis
