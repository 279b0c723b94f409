// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// As many unknowns as an element has motions, and one: they need no memory of their own.
constexpr int most_unknowns = 8;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_unknowns, 1>;

/// Where the exchange of `dual_simplex` ended.
struct Vertex {
  Unknowns x;
  Unknowns multipliers;  ///< of the constraints of the basis, in its order
  bool solved = false;
};

/// The x of least objective·x with column(j)·x ≥ cost(j) for every j, by the simplex method on the
/// dual (Stiefel 1959). The dual has as many rows as there are unknowns whatever the number of
/// constraints. The basis, one constraint an unknown, must be feasible (multipliers ≥ 0) and is
/// left as it ended, so that a problem alike starts from it.
///
/// `Constraints` has column(j), cost(j) and entering(x, exchange): a constraint that x breaks, or
/// none for the optimum.
template <typename Basis, typename Constraints>
Vertex dual_simplex(const Unknowns& objective, std::vector<Basis>& basis, Constraints& constraints,
                    int most_exchanges) {
  constexpr double least_pivot = 1e-11;
  const Eigen::Index n = objective.size();
  expects(n <= most_unknowns, "few unknowns");
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_unknowns, most_unknowns> columns(n,
                                                                                                 n);
  Unknowns cost(n);
  Vertex at;
  for (int exchange = 0; exchange < most_exchanges; ++exchange) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Basis& one = basis[static_cast<std::size_t>(j)];
      columns.col(j) = constraints.column(one);
      cost[j] = constraints.cost(one);
    }
    const Eigen::PartialPivLU<decltype(columns)> factors(columns);
    at.x = factors.transpose().solve(cost);
    at.multipliers = factors.solve(objective);
    const auto incoming = constraints.entering(at.x, exchange);
    at.solved = !incoming;
    if (!incoming) break;
    // The first whose multiplier it brings to zero goes out.
    const Unknowns pivot = factors.solve(constraints.column(*incoming));
    Eigen::Index leaves = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (pivot[j] <= least_pivot) continue;
      if (leaves < 0) {
        leaves = j;
        continue;
      }
      const double a = std::max(0.0, at.multipliers[j]) * pivot[leaves];
      const double b = std::max(0.0, at.multipliers[leaves]) * pivot[j];
      if (a < b || (a == b && pivot[j] > pivot[leaves])) leaves = j;
    }
    if (leaves < 0) break;  // nothing can go: the rest is rounding
    basis[static_cast<std::size_t>(leaves)] = *incoming;
  }
  return at;
}

}  // namespace trueaxis
