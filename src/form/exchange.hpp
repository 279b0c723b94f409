// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "trueaxis/association.hpp"

namespace trueaxis::form {

/// Parameters q of the nearest Σ q_k φ_k(i) to y_i. q_0 is the size: φ_0 = 1.
struct Nearest {
  Eigen::VectorXd q;
  /// The proof that there is nothing nearer (least squares: none): readings that the optimum
  /// touches, +1 where y is above, and multipliers ≥ 0 with Σ λ s φ = 0 (one-sided: the size's unit
  /// vector). Eq. 266.
  struct Touch {
    std::size_t reading;
    int side;
    double multiplier;
  };
  std::vector<Touch> touches;
  bool determined = true;  ///< false: the size has no limit (an arc of less than half a turn)
};

/// Least-squares, Chebyshev and one-sided approximation in a few unknowns over many readings, by an
/// exchange of active readings (the dual simplex method; of a zone Stiefel 1959). Exact but for
/// rounding; the cost is a few passes over the readings. Eqs. 265, 266.
class Exchange {
 public:
  using Rows = Eigen::MatrixXd;
  /// A reading that holds on one side.
  struct Active {
    std::ptrdiff_t reading;  ///< < 0: −1 − k, the wall of unknown k
    int side;
  };

  /// @param rows φ_k(i), a row a reading, the first column 1
  /// @param weight of each in the sum of squares; empty: 1
  Exchange(Rows rows, Criterion criterion, std::span<const double> weight = {});

  /// Least squares, which need no start.
  Nearest least_squares(std::span<const double> y) const;
  /// The values may change from call to call: the next one starts from what touched last.
  Nearest operator()(std::span<const double> y);

  /// y − Σ q_k φ_k of every reading.
  std::vector<double> off(std::span<const double> y, const Nearest& nearest) const;

 private:
  void begin();

  /// Shared by copies, which only start elsewhere.
  std::shared_ptr<const Rows> rows_, solver_;  ///< Φ, and WΦ (ΦᵀWΦ)⁻¹ of least squares
  Criterion criterion_;
  Eigen::VectorXd objective_;
  std::vector<Active> active_;
};

}  // namespace trueaxis::form
