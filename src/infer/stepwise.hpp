// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

namespace trueaxis::infer {

inline constexpr double better_by = 0.5;  ///< of the criterion, for a term to be exchanged

/// A list without one of its entries.
template <class Terms>
Terms without(Terms terms, std::size_t i) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
  return terms;
}

/// Takes the best term that passes its test after all others, one after the other.
template <class Side>
void take_what_passes(Side& side) {
  while (side.terms().size() < side.most()) {
    auto next = side.passing_beside(side.terms());
    if (!next) return;
    side.terms().push_back(std::move(*next));
    side.taken();
  }
}

/// A term stays if its test after all others passes; else the weakest goes, one after the other.
/// @returns whether one went
template <class Side>
bool drop_what_fails(Side& side) {
  bool changed = false;
  while (!side.terms().empty()) {
    std::size_t worst = 0;
    double worst_log_p = -1e300;
    for (std::size_t i = 0; i < side.terms().size(); ++i) {
      const double log_p = side.log_p(i);
      if (log_p > worst_log_p) worst_log_p = log_p, worst = i;
    }
    if (side.passes(worst_log_p)) return changed;
    side.terms() = without(std::move(side.terms()), worst);
    side.dropped();
    changed = true;
  }
  return changed;
}

/// Puts the best that `others` allow in the place of a term that is not among them, if the
/// criterion is better for it.
template <class Side, class Terms>
bool replace(Side& side, Terms others) {
  auto best = side.best_beside(others);
  if (!best) return false;
  others.push_back(std::move(*best));
  if (side.criterion(others) > side.criterion(side.terms()) - better_by) return false;
  side.terms() = std::move(others);
  return true;
}

/// Every term against the best there is in its place.
template <class Side>
bool exchange_each(Side& side) {
  bool changed = false;
  for (std::size_t i = 0; i < side.terms().size(); ++i)
    if (side.may_leave(i)) changed |= replace(side, without(side.terms(), i));
  return changed;
}

/// Terms taken, dropped and exchanged one by one until nothing changes (theory.md, §8.2). A
/// side has columns, a catalogue and what it knows of both:
///   terms(), most()                the model, and how many terms it may have
///   passing_beside(terms)          the best term that passes its test, if any
///   best_beside(terms)             the best term at all, if any
///   log_p(i), passes(log_p)        test of a term after all others
///   criterion(terms)               what models are compared by: Fitted::criterion
///   may_leave(i), exchange()       whether a term may be exchanged; exchange_each and what else
///   taken(), dropped()             called at a change, as of noise that is estimated after terms
template <class Side>
void search_stepwise(Side& side) {
  take_what_passes(side);
  for (int round = 0; round < 3; ++round) {
    bool changed = drop_what_fails(side);
    changed |= side.exchange();
    if (!changed) break;
    take_what_passes(side);
  }
  drop_what_fails(side);
}

}  // namespace trueaxis::infer
