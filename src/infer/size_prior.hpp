// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "infer/gram.hpp"

namespace trueaxis::infer {

/// How large a term may be before the data speak: each coefficient is normal about 0, its scale
/// log-normal over the sizes that the catalogue calls typical (Eq. 79).
struct SizePrior {
  Eigen::VectorXd median;  ///< of the scale of every column, mm, rad, s; 0: no size is known
  double spread = 1.0;     ///< standard deviation of the logarithm of the scale
  Eigen::VectorXd least{}, most{};  ///< what a column may be at all; empty: anything
  double most_of_first = 0.0;       ///< what the last pair may be of the first one; 0: anything
  bool own_scale_of_last = false;   ///< whether the last pair of four has a scale of its own
  /// Of a size that a user states: standard deviation in medians of what it may be off, 0: nothing
  /// is stated; and the probability that the statement is wrong, and the size a typical one.
  double stated = 0.0, doubt = 1.0;

  /// The scale that many spreads above the median; 0: no size is known.
  Eigen::VectorXd scale(double spreads) const { return std::exp(spreads * spread) * median; }

  bool allows(const Eigen::VectorXd& size) const;
};

constexpr double open_end = 0.05;  ///< share of the upper end where a range begins at 0

/// Standard deviation of the logarithm of a size of which 95 % lie between two; no range of a
/// handbook is sharper than 0.7.
double spread_of_size(double log_high_over_low);

/// What data and prior say of a term after others.
struct Weighed {
  double criterion = 0.0;      ///< −2 ln of the marginal likelihood over that without the term
  Eigen::VectorXd mean;        ///< of the coefficients
  Eigen::MatrixXd covariance;  ///< of them
  Eigen::VectorXd precision;   ///< what the prior adds to the normal matrix where it is largest
  bool possible = true;        ///< whether the mean is within what the sizes may be
  bool extraordinary = false;  ///< whether it is beyond three spreads: 1 of 700 is
};

/// Marginal likelihood and moments of a term's coefficients over the mixture of scales (Eq. 80).
/// Scales that are not known are those of one reading's information (Kass and Wasserman 1995).
/// @param gram, right the term's columns and their products with the readings, others taken out
/// @param norm2 of the columns before that
/// @param rss sum of squares without the term, of `freedom` degrees of freedom
Weighed weigh(const SizePrior& prior, const Eigen::MatrixXd& gram, const Eigen::VectorXd& right,
              const Eigen::VectorXd& norm2, double rss, double freedom);

/// The same of columns after what the projection took out.
/// @param count rows of the equations
Weighed weigh(const SizePrior& prior, const Projection& projection, const Columns& own,
              std::size_t count);

}  // namespace trueaxis::infer
