// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace trueaxis::infer {

/// A term stays if its test beside all others passes; else the weakest goes, one after the other.
/// @returns whether one went
template <class Side>
bool drop_what_fails(Side& side) {
  bool changed = false;
  while (side.size() > 0) {
    std::size_t worst = 0;
    double worst_log_p = -1e300;
    for (std::size_t i = 0; i < side.size(); ++i) {
      const double log_p = side.log_p(i);
      if (log_p > worst_log_p) worst_log_p = log_p, worst = i;
    }
    if (side.passes(worst_log_p)) return changed;
    side.drop(worst);
    changed = true;
  }
  return changed;
}

/// Terms taken, dropped and exchanged one by one until nothing changes (docs/theory.md, §8.2). A
/// side has a model: `forward()` takes what passes, `exchange()` puts better terms in the place of
/// others, `log_p(i)` is that of a term beside all others, `size()` their number.
template <class Side>
void search_stepwise(Side& side) {
  side.forward();
  for (int round = 0; round < 3; ++round) {
    bool changed = drop_what_fails(side);
    changed |= side.exchange();
    if (!changed) break;
    side.forward();
  }
  drop_what_fails(side);
}

}  // namespace trueaxis::infer
