// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/regression.hpp"

namespace trueaxis::calibrate_detail {

/// What the search is told and what its verdicts are worth.
struct SearchOptions {
  double false_alarm = 0.01;
  double tests = 1.0;  ///< Bonferroni: all that are tried
  std::size_t most = 6;
  double single_level() const { return false_alarm / tests; }
};

/// Chance of the F test of `term` beside `others` (Eq. 179).
double chance(const Regression& regression, const Regression::Set& others, std::size_t term);

/// −2 ln L of a set with its parameters paid for (Eq. 180): 2 a column, 4 more a pattern.
double criterion(const Regression& regression, const std::vector<Term>& terms,
                 const Regression::Set& set);

/// The terms that explain the residuals: forward one at a time, every pair of the best hundred once
/// there is one, each exchanged for a better one, and those dropped that no longer pass.
Regression::Set search(const Regression& regression, const std::vector<Term>& terms,
                       const SearchOptions& options);

}  // namespace trueaxis::calibrate_detail
