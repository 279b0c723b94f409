// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "studies/published/published.hpp"
#include "study/sweep/summary.hpp"

namespace trueaxis::study {

/// A published run in the distribution that one reading gives it.
struct PlacedRow {
  std::size_t row = 0;          ///< of Published::rows
  std::vector<double> error;    ///< of each parameter as the reading understands it, edge unit
  std::vector<double> in_sd;    ///< over the bound's standard deviation
  double chi_squared = 0.0;     ///< Mahalanobis distance squared, rounding in print included
  double p_value = 0.0;         ///< of a χ² with as many degrees of freedom as parameters
  double log_likelihood = 0.0;  ///< of the printed numbers
};

/// The published runs under one reading; rows whose noise is not known are excluded.
struct PlacedReading {
  std::vector<PlacedRow> rows;
  double chi_squared = 0.0, p_value = 0.0;  ///< of all rows together
  double log_likelihood = 0.0;
  double gain = 0.0;          ///< of log-likelihood over the first reading
  double noise_factor = 1.0;  ///< true noise over the stated one
  Ends noise_factor_95;       ///< profile likelihood; NaN where it was not estimated
};

/// A noise level that print has lost, in the unit of its axis' path: profile likelihood under one
/// reading, together with the rows that are whole where the noise factor is estimated.
struct UnknownLevel {
  std::size_t row = 0, reading = 0;
  double unit = 1.0;  ///< of the axis' labels, where these are numbers
  double best = 0.0;
  Ends interval_95;  ///< NaN where the likelihood stays above on that side
  struct AtPoint {
    double level = 0.0, below_best = 0.0;  ///< log-likelihood lost
  };
  std::vector<AtPoint> points;  ///< at the points of the axis
};

/// A published run among the repeats of its cell, which are rounded as it was printed.
struct AmongRepeats {
  std::size_t row = 0, cell = 0;
  std::vector<double> share_below;  ///< of repeats, half of those that print the same number
  double share_as_far = 0.0;        ///< of repeats whose Mahalanobis distance is not less
};

struct Placement {
  std::vector<PlacedReading> readings;
  std::vector<UnknownLevel> unknown;
  std::vector<AmongRepeats> among;  ///< of the cells of the first method
  std::string why_not;              ///< nothing can be placed: the rest is empty
};

/// Where the published runs of a sweep fall. The covariance of a run is the bound's, noise at the
/// reading's factor, plus d²/12 for a number printed to steps of d; an error printed as c times the
/// quantity's is divided by c. χ² = eᵀV⁻¹e. Log-likelihoods are of the printed numbers (densities
/// per mm, 1 and degree), so that readings compare. Nothing is placed where there is no bound.
/// Eq. 126.
Placement place_published(const Sweep& sweep, const Published& published,
                          const std::vector<BlockResult>& results);

}  // namespace trueaxis::study
