// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "diagnose/search/scan_list.hpp"

namespace trueaxis::diagnose_detail {

/// For every pass, how many readings count with those that predict them.
std::vector<double> readings_that_count(const NormalEquations& equations);

/// Squares of the whitened columns of the lines in one variable.
class LineNorms {
 public:
  /// @param equations outlive this
  /// @param counts readings_that_count
  /// @param means where the readings are such
  LineNorms(const NormalEquations& equations, std::vector<double> counts, PointColumn x,
            const Means* means);

  const std::vector<double>& autoregression() const { return equations_.autoregression(); }
  /// The norms of cos and of sin (2π f x − turns θ), f = low, low + df …
  std::vector<double> of(const Scan& scan, double low, double df, std::size_t bins) const;

 private:
  std::vector<double> by_mean_step(const Scan& scan, double low, double df, std::size_t bins) const;
  std::vector<double> by_every_step(const Scan& scan, double low, double df,
                                    std::size_t bins) const;

  const NormalEquations& equations_;
  PointColumn x_;
  /// For each pass: readings_that_count, and the mean step of C and x from one to the next.
  std::vector<double> used_, c_step_, x_step_;
};

}  // namespace trueaxis::diagnose_detail
