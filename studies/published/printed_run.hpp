// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "studies/published/published.hpp"
#include "study/bound/bound.hpp"

namespace trueaxis::study {

/// One printed run as a reading understands it: errors of the parameters and their covariance.
struct PrintedRun {
  std::vector<double> error;  ///< edge unit
  std::vector<double> step;   ///< to which the error was rounded
  std::vector<double> truth;
  Eigen::MatrixXd covariance;          ///< of the noise as stated
  double log_printed_per_error = 0.0;  ///< Σ ln of the parameters' factors

  struct Likelihood {
    double chi_squared = 0.0, log_likelihood = 0.0;
  };
  /// Of these errors with `factor` times the stated noise. NaN where there is no bound.
  Likelihood of(std::span<const double> errors, double factor) const;
  Likelihood at(double factor) const { return of(error, factor); }

  std::vector<double> in_sd(double factor) const;

  /// An error of parameter i as its print leaves it.
  double as_printed(std::size_t i, double exact) const;
};

/// @param quantity of every published parameter, in truth and bound
PrintedRun printed_run(const PublishedRow& row, const PublishedReading& reading,
                       const std::vector<std::size_t>& quantity, const std::vector<double>& truth,
                       const Bound& bound);

}  // namespace trueaxis::study
