// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// How many tests a verdict is the best of: those one by one, and those of the periodograms, whose
/// number grows with the statistic (Rice's rate of upcrossings; Baluev 2008, eq. 6) (Eqs. 70, 71).
struct Family {
  double single = 0.0;
  double bandwidth = 0.0;

  /// Probability that the largest of all statistics passes one with this single p-value by chance.
  double p_value(double single_p) const;
  /// Statistic with two degrees of freedom that does so with probability `level`.
  double threshold(double level) const;
};

/// Twice the log of the choice among a hypothesis's kind (Chen and Chen 2008), and what a second
/// harmonic costs that no jaws make (Eqs. 78, 80a).
double choice_of(const Hypothesis& hypothesis, const Eigen::VectorXd& coefficients);

/// ln p of an F test: `gain` for `rank` columns off `rss` with `freedom` degrees of freedom before.
/// Eq. 69.
double log_p_value(double gain, double rank, double rss, double freedom);

/// Sum of squares of a block that was held out, predicted by columns fitted to the others (Eq. 82).
double held_out(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold, const Columns& columns);
/// The same to rounding, and faster: where the columns are independent beyond doubt their
/// coefficients are from a Cholesky factor.
double held_out_fast(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold,
                     const Columns& columns);

}  // namespace trueaxis::diagnose_detail
