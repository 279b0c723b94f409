// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/regression.hpp"
#include "infer/significance.hpp"

namespace trueaxis::calibrate_detail {

/// How the false alarm of a measurement is shared out.
inline constexpr double share_of_effects = 0.6, share_of_patterns = 0.3, share_of_scatter = 0.1;

/// What the search is told and what its verdicts are worth.
struct SearchOptions {
  double false_alarm = 0.01;  ///< of everything
  double tests = 1.0;         ///< all effects that are tried, at every place
  double pattern_tests = 1.0;
  std::size_t most = 6;

  infer::Family effects() const { return {tests / share_of_effects, 0.0}; }
  infer::Family family_of(const Term& term) const {
    return term.pattern ? infer::Family{pattern_tests / share_of_patterns, 0.0} : effects();
  }
};

/// Those of effects that have a direction these rows show.
double tests_of(const Regression& regression, const std::vector<Term>& terms);

/// ln p of the F test of `term` beside others (Eq. 179).
double log_p_of(const Regression& regression, const infer::Projection& beside, std::size_t term);
/// p of it in its family.
double family_p(const SearchOptions& options, const Term& term, double log_p);

/// Data and prior of a term, whose columns are these, beside others, with what its choice among
/// many and that it is a pattern cost (Eqs. 78, 80).
infer::Weighed weighed(const Regression& regression, const std::vector<Term>& terms,
                       std::size_t term, const infer::Projection& beside,
                       const infer::Columns& columns);

/// The terms that explain the residuals: forward one at a time, every pair of the best hundred
/// beside the first, those dropped that no longer pass, and each exchanged for a better one.
Regression::Set search(const Regression& regression, const std::vector<Term>& terms,
                       const SearchOptions& options);

}  // namespace trueaxis::calibrate_detail
