// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "math/autoregression.hpp"

namespace trueaxis::diagnose_detail {

/// Columns [deviation | base | terms] of readings [begin, end).
Eigen::MatrixXd columns_of_rows(const LinearisationPoint& point, std::span<const double> deviation,
                                std::span<const Hypothesis> terms, std::size_t begin,
                                std::size_t end);

/// Deviation minus base and terms at a solution; the solution's columns are in the order base,
/// terms.
std::vector<double> remainder(const LinearisationPoint& point, std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms, const Eigen::VectorXd& solution,
                              int threads = 1);

/// Autoregressions of the noise after base, basis and terms, whose products without the terms are
/// made once. By restricted maximum likelihood (the columns are integrated out, so that fitting
/// them does not hide correlation); order 0, 1 or 2, each one only where the likelihood ratio
/// passes 5 %. Few readings: none; so many that the columns do not matter: up to order 6 (Eqs. 64,
/// 65, 65a).
class NoiseEstimator {
 public:
  /// @param point, deviation_mm outlive this
  NoiseEstimator(const LinearisationPoint& point, const ObservationMask& mask,
                 std::span<const double> deviation_mm, std::span<const Hypothesis> basis,
                 int threads = 1);

  Autoregression operator()(std::span<const Hypothesis> terms) const;

 private:
  /// Readings in a row, and which of them show the noise.
  struct Stretch {
    std::size_t begin, end;
    std::vector<Eigen::Index> later, first, second;
    LaggedRows rows_of(const Eigen::MatrixXd& columns) const;
  };
  std::vector<Stretch> stretches_of(const ObservationMask& mask) const;
  /// What the columns at these coefficients leave, in readings that follow each other.
  std::vector<std::vector<double>> residual_runs(std::span<const Hypothesis> terms,
                                                 const Eigen::VectorXd& coefficients) const;

  const LinearisationPoint* point_;
  std::span<const double> deviation_mm_;
  std::vector<Hypothesis> basis_;
  int threads_;
  std::vector<Stretch> stretches_;
  std::vector<LaggedRows> rows_;  ///< of the deviation, base and basis, stretch by stretch
  LaggedGram gram_;
};

/// The same after one list of terms.
Autoregression autoregression(const LinearisationPoint& point, const ObservationMask& mask,
                              std::span<const double> deviation_mm,
                              std::span<const Hypothesis> terms, int threads = 1);

}  // namespace trueaxis::diagnose_detail
