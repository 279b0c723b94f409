// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/regression.hpp"

namespace trueaxis::calibrate_detail {

/// What the search is told and what its verdicts are worth.
struct SearchOptions {
  double measurement_alarm = 0.01;  ///< of everything
  double false_alarm = 0.006;       ///< of all effects together
  double tests = 1.0;               ///< Bonferroni: all effects that are tried
  double pattern_alarm = 0.003;     ///< of all patterns together
  double pattern_tests = 1.0;
  std::size_t most = 6;
  double single_level() const { return false_alarm / tests; }
  double level_of(const Term& term) const {
    return term.pattern ? pattern_alarm / pattern_tests : single_level();
  }
};

/// Chance of the F test of `term` beside `others` (Eq. 179).
double chance(const Regression& regression, const Regression::Set& others, std::size_t term);

/// −2 ln L of a set with its parameters and places paid for (Eq. 180): 2 a column, 4 more a
/// pattern.
double criterion(const Regression& regression, const std::vector<Term>& terms,
                 const Regression::Set& set);

/// The terms that explain the residuals: forward one at a time, every pair of the best hundred once
/// there is one, each exchanged for a better one, and those dropped that no longer pass.
Regression::Set search(const Regression& regression, const std::vector<Term>& terms,
                       const SearchOptions& options);

}  // namespace trueaxis::calibrate_detail
