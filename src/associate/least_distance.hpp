// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace trueaxis {

/// The shortest x with C x ≤ b, and the multipliers λ ≥ 0 of the rows with x = −Cᵀ λ.
struct LeastDistance {
  Eigen::VectorXd x, multipliers;
  bool solved = false;  ///< false: no x keeps all rows
};

/// By the problem's dual, which has no constraint but λ ≥ 0 (Lawson and Hanson, Solving Least
/// Squares Problems, 1974, algorithms NNLS and LDP). Rows may be many, unknowns are few.
LeastDistance least_distance(const Eigen::MatrixXd& c, const Eigen::VectorXd& b);

}  // namespace trueaxis
