// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trueaxis {

/// φ of ε_i = Σ φ_j ε_{i−j} + e_i; empty: white.
struct Autoregression {
  std::vector<double> phi;
  double rss = 0.0;      ///< of what is left, whitened; 0: there were too few readings to tell
  double freedom = 0.0;  ///< of it: readings beyond the columns
};

/// Products of columns with those one and two readings earlier, all over the same readings. The
/// first column is what shows the noise, the others are those of the model beside it.
class LaggedGram {
 public:
  explicit LaggedGram(Eigen::Index columns);

  /// Adds rows of `x`; the two rows before each of them are those of the two readings before.
  void add(const Eigen::MatrixXd& x, std::span<const Eigen::Index> rows);
  /// Adds the products of x · t for x whose products are `other`.
  void add_transformed(const LaggedGram& other, const Eigen::MatrixXd& t);

  double rows() const { return rows_; }
  const Eigen::MatrixXd& at(std::size_t a, std::size_t b) const { return gram_[a][b]; }

  /// Only the columns that are independent of those before them.
  LaggedGram of_independent_columns() const;
  Eigen::MatrixXd whitened(double phi1, double phi2) const;

 private:
  std::array<std::array<Eigen::MatrixXd, 3>, 3> gram_;  ///< of the lags a ≤ b
  double rows_ = 0.0;
};

/// Autoregression of the first column beside the others by restricted maximum likelihood (Patterson
/// and Thompson 1971): order 0, 1 or 2, each one only where the likelihood ratio passes 5 %, the
/// second only where it is noise and `is_form(φ₁, φ₂)` does not take it for something else (Eqs.
/// 64, 65).
Autoregression find_autoregression(const LaggedGram& of_all_columns,
                                   const std::function<bool(double, double)>& is_form);

/// Whether an autoregression of the second order rings with the spindle, whose angles at the
/// readings are given: nothing random does, but what turns with it and is not explained looks so.
bool rings_with_spindle(double phi1, double phi2, std::span<const double> c_rad);

/// Variance of one reading over that of the innovation e, of order 0, 1 or 2.
double variance_over_innovation(const std::vector<double>& phi);

}  // namespace trueaxis
