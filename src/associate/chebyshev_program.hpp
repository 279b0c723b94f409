// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace trueaxis {

/// The linear program of a Chebyshev problem (Eq. 249): the least h and the step δ in the box
/// |δ_k| ≤ reach with g + A δ ≤ h in every row.
struct ChebyshevProgram {
  Eigen::VectorXd g;
  Eigen::MatrixXd a;  ///< a row for each g
};

struct ChebyshevSolution {
  Eigen::VectorXd step;
  double h = 0.0;
  /// The rows that hold h up and their multipliers λ > 0; where the box holds the step Σ λ A is not
  /// 0.
  std::vector<std::size_t> rows;
  std::vector<double> multipliers;
  bool solved = false;
};

/// By Stiefel's exchange: the simplex method on the dual, which has as many rows as there are
/// unknowns, whatever the number of constraints. Rows may be many, unknowns are few.
ChebyshevSolution solve(const ChebyshevProgram& program, double reach, double tolerance);

}  // namespace trueaxis
