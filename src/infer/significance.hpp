// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace trueaxis::infer {

/// ln p of an F test: `gain` for `rank` columns off `rss` with `freedom` degrees of freedom before.
/// Eq. 69.
double log_p_value(double gain, double rank, double rss, double freedom);

/// How many tests a verdict is the best of: those one by one, and those of the periodograms, whose
/// number grows with the statistic (Rice's rate of upcrossings; Baluev 2008, eq. 6) (Eqs. 70, 71).
struct Family {
  double single = 0.0;
  double bandwidth = 0.0;

  /// Probability that the largest of all statistics of noise passes one with this single p-value.
  double p_value(double single_p) const;
  /// Statistic with two degrees of freedom that does so with probability `level`.
  double threshold(double level) const;
  /// The single p-value that does so.
  double single_level(double level) const;
};

/// Degrees of freedom of a σ that is known: the F test is then one of χ².
inline constexpr double known_sigma = std::numeric_limits<double>::infinity();

/// Probability that a test of `rank` columns with `freedom` further degrees of freedom, of
/// noncentrality λ, has a p-value below `single_p` (Eqs. 97, 182).
double detection_power(double lambda, double rank, double freedom, double single_p);

/// λ at which that probability is `power`.
double required_lambda(double rank, double freedom, double single_p, double power);

}  // namespace trueaxis::infer
