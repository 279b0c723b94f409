// SPDX-License-Identifier: Apache-2.0
#include "calibrate/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibrate/periodic_fit.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Set = Regression::Set;

constexpr std::size_t of_pairs = 100;
constexpr double price_of_pattern = 4.0;

double price(const Regression& regression, const Term& term, std::size_t at) {
  return 2.0 * static_cast<double>(regression.block(at).rank) +
         (term.pattern ? price_of_pattern : 0.0) + 2.0 * std::log(term.tests);
}

struct Best {
  std::size_t term = 0;
  double criterion = std::numeric_limits<double>::infinity();
};

/// Of all terms the best one beside `others`. @param effects_only without patterns
Best best_beside(const Regression& regression, const std::vector<Term>& terms, const Set& others,
                 bool effects_only = false) {
  const Regression::Beside left = regression.beside(others);
  double paid = 0.0;
  for (const std::size_t other : others) paid += price(regression, terms[other], other);
  Best best;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto& block = regression.block(t);
    if (block.rank == 0 || terms[t].barred || (effects_only && terms[t].pattern) ||
        std::ranges::find(others, t) != others.end())
      continue;
    const double gain =
        gain_of(left.products.block(block.first, block.first, block.rank, block.rank),
                left.right.segment(block.first, block.rank));
    const double value = regression.freedom() * std::log(std::max(left.rss - gain, 1e-300)) + paid +
                         price(regression, terms[t], t);
    // Of two alike (orders that the positions alias) the first stands.
    if (value < best.criterion - 1e-6) best = {t, value};
  }
  return best;
}

Set without(Set set, std::size_t at) {
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(at));
  return set;
}

/// Exchanges one at a time for a better one until none is.
void exchange(const Regression& regression, const std::vector<Term>& terms, Set& set) {
  double now = criterion(regression, terms, set);
  for (int round = 0; round < 10; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const Set others = without(set, i);
      const Best best = best_beside(regression, terms, others);
      if (best.criterion >= now - 1e-6) continue;
      set[i] = best.term;
      now = best.criterion;
      changed = true;
    }
    if (!changed) return;
  }
}

/// The best pair of the terms that do most alone: of two effects a third may look most like both.
Set best_pair(const Regression& regression, const std::vector<Term>& terms) {
  std::vector<std::pair<double, std::size_t>> alone;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (regression.block(t).rank > 0 && !terms[t].barred)
      alone.emplace_back(-regression.gain({t}), t);
  std::ranges::sort(alone);
  if (alone.size() > of_pairs) alone.resize(of_pairs);
  Set best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < alone.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Set pair{alone[a].second, alone[b].second};
      const double value = criterion(regression, terms, pair);
      if (value < least) least = value, best = pair;
    }
  return best;
}

/// Whether every one of a set passes beside the others; the weakest goes where one does not.
bool drop_weakest(const Regression& regression, const std::vector<Term>& terms,
                  const SearchOptions& options, Set& set) {
  double worst = 1.0;  // over the level
  std::size_t at = set.size();
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double p = chance(regression, without(set, i), set[i]) / options.level_of(terms[set[i]]);
    if (p >= worst) worst = p, at = i;
  }
  if (at == set.size()) return false;
  set = without(set, at);
  return true;
}

void settle(const Regression& regression, const std::vector<Term>& terms,
            const SearchOptions& options, Set& set) {
  exchange(regression, terms, set);
  while (drop_weakest(regression, terms, options, set)) exchange(regression, terms, set);
}

}  // namespace

double chance(const Regression& regression, const Set& others, std::size_t term) {
  const auto& block = regression.block(term);
  const Regression::Beside left = regression.beside(others);
  const auto rank = static_cast<double>(block.rank);
  const double gain = gain_of(left.products.block(block.first, block.first, block.rank, block.rank),
                              left.right.segment(block.first, block.rank));
  return chance_of(gain, rank, left.rss - gain, left.freedom - rank);
}

double criterion(const Regression& regression, const std::vector<Term>& terms, const Set& set) {
  double sum =
      regression.freedom() * std::log(std::max(regression.rss() - regression.gain(set), 1e-300));
  for (const std::size_t t : set) sum += price(regression, terms[t], t);
  return sum;
}

Set search(const Regression& regression, const std::vector<Term>& terms,
           const SearchOptions& options) {
  Set set;
  while (set.size() < options.most) {
    const auto passes = [&](const Best& one) {
      return std::isfinite(one.criterion) &&
             chance(regression, set, one.term) < options.level_of(terms[one.term]);
    };
    Best best = best_beside(regression, terms, set);
    if (!passes(best)) best = best_beside(regression, terms, set, true);
    if (!passes(best)) break;
    Set more = set;
    more.push_back(best.term);
    settle(regression, terms, options, more);
    if (more.size() <= set.size() &&
        criterion(regression, terms, more) >= criterion(regression, terms, set))
      break;
    const bool first = set.empty();
    set = std::move(more);
    if (!first) continue;
    Set pair = best_pair(regression, terms);
    settle(regression, terms, options, pair);
    if (pair.size() == 2 && criterion(regression, terms, pair) < criterion(regression, terms, set))
      set = std::move(pair);
  }
  return set;
}

}  // namespace trueaxis::calibrate_detail
