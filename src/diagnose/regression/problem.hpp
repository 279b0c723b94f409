// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "diagnose/geometry/resolution.hpp"

namespace trueaxis::diagnose_detail {

/// The effects that may be causes: those of the catalogue, then a user's own; no checks.
inline std::vector<const Effect*> possible_causes(std::span<const Effect> own = {}) {
  std::vector<const Effect*> list;
  for (const std::span<const Effect> some : {effect_catalogue(), own})
    for (const Effect& effect : some)
      if (!std::holds_alternative<std::monostate>(effect.term)) list.push_back(&effect);
  return list;
}

/// What a search is given and does not change.
struct Problem {
  const LinearisationPoint& point;
  const ObservationMask& mask;
  const Resolution& resolution;
  std::span<const double> deviation_mm;
  double false_alarm = 0.01;
  int threads = 1;
  std::size_t most_terms = 8;
  std::vector<const Effect*> effects = possible_causes();

  /// The same readings about another point.
  Problem about(const LinearisationPoint& other, std::span<const double> deviation) const {
    return {other, mask, resolution, deviation, false_alarm, threads, most_terms, effects};
  }
};

}  // namespace trueaxis::diagnose_detail
