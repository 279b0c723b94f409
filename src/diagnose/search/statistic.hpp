// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// How many tests a verdict is the best of: those one by one, and those of the periodograms, whose
/// number grows with the statistic (Rice's rate of upcrossings; Baluev 2008, eq. 6).
struct Family {
  double single = 0.0;
  double bandwidth = 0.0;

  /// Probability that the largest of all statistics passes one with this single p-value by chance.
  double p_value(double single_p) const;
  /// Statistic with two degrees of freedom that does so with probability `level`.
  double threshold(double level) const;
};

/// ln n per column, twice the log of the choice among its kind (Chen and Chen 2008), and what an
/// implausible size costs.
double penalty(const Hypothesis& hypothesis, std::size_t rank, std::size_t count,
               const Eigen::VectorXd& coefficients);

/// ln p of an F test: `gain` for `rank` columns off `rss` with `freedom` degrees of freedom before.
double log_p_value(double gain, double rank, double rss, double freedom);

/// Sum of squares of a block that was held out, predicted by columns fitted to the others.
double held_out(const Eigen::MatrixXd& total, const Eigen::MatrixXd& fold, const Columns& columns);

}  // namespace trueaxis::diagnose_detail
