// SPDX-License-Identifier: Apache-2.0
#include "associate/least_distance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

/// min |E u − f|, u ≥ 0, over the columns of E; u is not 0 in as many columns as there are rows at
/// most.
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& e, const Eigen::VectorXd& f) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(e.cols());
  std::vector<Eigen::Index> free;
  const double rounding = 1e-15 * e.colwise().norm().maxCoeff() * f.norm();
  for (int exchange = 0; exchange < 1000; ++exchange) {
    Eigen::VectorXd pull = e.transpose() * (f - e * u);
    for (const Eigen::Index j : free) pull[j] = 0.0;
    Eigen::Index in = 0;
    if (pull.maxCoeff(&in) <= rounding || free.size() >= static_cast<std::size_t>(e.rows())) break;
    free.push_back(in);
    while (!free.empty()) {
      Eigen::MatrixXd part(e.rows(), static_cast<Eigen::Index>(free.size()));
      for (std::size_t k = 0; k < free.size(); ++k)
        part.col(static_cast<Eigen::Index>(k)) = e.col(free[k]);
      const Eigen::VectorXd best = linear::pivoted_least_squares(part, f);
      double step = 1.0;
      std::size_t leaves = free.size();
      for (std::size_t k = 0; k < free.size(); ++k) {
        const double to = best[static_cast<Eigen::Index>(k)], from = u[free[k]];
        if (to > 0.0 || from - to <= 0.0) continue;
        if (from / (from - to) < step) step = from / (from - to), leaves = k;
      }
      for (std::size_t k = 0; k < free.size(); ++k)
        u[free[k]] += step * (best[static_cast<Eigen::Index>(k)] - u[free[k]]);
      if (leaves == free.size()) break;
      u[free[leaves]] = 0.0;
      free.erase(free.begin() + static_cast<std::ptrdiff_t>(leaves));
    }
  }
  return u;
}

}  // namespace

LeastDistance least_distance(const Eigen::MatrixXd& c, const Eigen::VectorXd& b) {
  const Eigen::Index n = c.cols(), m = c.rows();
  Eigen::MatrixXd e(n + 1, m);
  e.topRows(n) = -c.transpose();
  e.row(n) = -b.transpose();
  const Eigen::VectorXd f = Eigen::VectorXd::Unit(n + 1, n);
  const Eigen::VectorXd u = non_negative_least_squares(e, f), r = e * u - f;
  LeastDistance out;
  if (r.norm() < 1e-12) return out;
  out.x = -r.head(n) / r[n];
  out.multipliers = -u / r[n];
  out.solved = out.x.allFinite();
  return out;
}

}  // namespace trueaxis
