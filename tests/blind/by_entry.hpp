// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blind/families.hpp"
#include "blind/rival.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis::blind {

/// What the judge takes from an effect's entry where no table of its own has the effect: its sizes,
/// and the parameter that its shape hangs on.
struct ByEntry {
  const trueaxis::Effect* entry = nullptr;
  Family family;
  std::string_view shape;  ///< the lathe's name of it; empty: there is none
  double low = 0.0, high = 0.0;
  bool whole = false;  ///< an order or a degree

  /// `unit` of 0 to 1 of the typical range, in octaves where it has them.
  double value(double unit) const;
};

ByEntry by_entry(const trueaxis::Effect& entry);

/// nullptr: a table of the judge has it, or it is not an effect of a lateral surface.
const ByEntry* known_by_entry(std::string_view id);

/// Shapes at which it can mimic the residual: lines of the spectrum that its entry names, or values
/// over the typical range.
std::vector<Effect> mimics(const Bench& bench, const ByEntry& of, const Residue& left);

/// A shape parameter that is refined: over a bracket of ± `span` (`relative`: a factor).
struct Refinement {
  std::string name;
  double span = 0.0;
  bool relative = false;
};
std::optional<Refinement> refinement(const Bench& bench, const ByEntry& of, const Effect& shaped);

}  // namespace trueaxis::blind
