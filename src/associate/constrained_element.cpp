// SPDX-License-Identifier: Apache-2.0

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "associate/distance_kernel.hpp"
#include "associate/extreme_element.hpp"
#include "associate/least_squares.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

/// The shortest x with C x ≤ b, and the multipliers λ ≥ 0 of the rows with x = −Cᵀ λ.
struct LeastDistance {
  Eigen::VectorXd x, multipliers;
  bool solved = false;  ///< false: no x keeps all rows
};

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

/// By the problem's dual, which has no constraint but λ ≥ 0 (Lawson and Hanson, Solving Least
/// Squares Problems, 1974, algorithms NNLS and LDP). Rows may be many, unknowns are few.
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

/// Rows s (d + J δ) ≤ 0 of the chosen points, steps in mm.
struct OneSided {
  Eigen::MatrixXd a;
  Eigen::VectorXd value;  ///< s d
};

OneSided one_sided(const Placed& placed, const PointCloud& cloud, double sign) {
  const std::size_t n = cloud.points.size(), p = traits_of(placed.shape).parameters;
  const Parameters per = step_lengths(placed.shape, cloud).cwiseInverse();
  OneSided out{Eigen::MatrixXd(n, p), Eigen::VectorXd(n)};
  DistanceBlock block;
  for (std::size_t at = 0; at < n; at += block_size) {
    const std::size_t count = std::min(block_size, n - at);
    evaluate_distances(placed, cloud.points.subspan(at, count), block);
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(at + i);
      out.value[row] = sign * block.column[p][i];
      for (std::size_t k = 0; k < p; ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        out.a(row, column) = sign * per[column] * block.column[k][i];
      }
    }
  }
  return out;
}

/// A step of sequential quadratic programming and what holds it.
struct QuadraticStep {
  Eigen::VectorXd step, multipliers;
  double stationarity = 0.0;
  bool solved = false;
};

/// min ½ δᵀHδ + gᵀδ under the rows: the shortest y = Lᵀδ + L⁻¹g with H = L Lᵀ.
QuadraticStep quadratic_step(const NormalSums& normal, const OneSided& rows, const Parameters& per,
                             double points) {
  const Eigen::MatrixXd h = per.asDiagonal() * normal.jtj * per.asDiagonal() / points;
  const Eigen::VectorXd g = per.cwiseProduct(normal.jtd) / points;
  const Eigen::LLT<Eigen::MatrixXd> llt(h);
  const Eigen::VectorXd from = llt.matrixL().solve(g);
  const Eigen::MatrixXd c = llt.matrixL().solve(rows.a.transpose()).transpose();
  const LeastDistance nearest = least_distance(c, c * from - rows.value);
  QuadraticStep out;
  if (llt.info() != Eigen::Success || !nearest.solved) return out;
  out.step = llt.matrixU().solve(nearest.x - from);
  out.multipliers = nearest.multipliers;
  out.stationarity = (g + rows.a.transpose() * out.multipliers).norm();
  out.solved = out.step.allFinite();
  return out;
}

/// With the points chosen so far as constraints and all of them in the sum.
void search(Minimax& best, const PointCloud& cloud, const PointCloud& chosen, double sign,
            int max_iterations) {
  const Parameters per = step_lengths(best.placed.shape, cloud).cwiseInverse();
  double last = std::numeric_limits<double>::infinity();
  best.converged = false;
  for (int i = 0; i < max_iterations && !best.converged; ++i, ++best.iterations) {
    const OneSided rows = one_sided(best.placed, chosen, sign);
    const QuadraticStep step = quadratic_step(accumulate(best.placed, cloud), rows, per,
                                              static_cast<double>(cloud.points.size()));
    if (!step.solved) return;
    const double length = step.step.norm();
    best.stationarity = step.stationarity;
    best.contacts.clear();
    for (Eigen::Index row = 0; row < rows.value.size(); ++row)
      if (step.multipliers[row] > 1e-13 * cloud.length)
        best.contacts.push_back({static_cast<std::size_t>(row), sign > 0.0 ? 1 : -1,
                                 sign * rows.value[row], step.multipliers[row]});
    best.converged =
        length <= 1e-13 * cloud.length || (length <= 1e-10 * cloud.length && length >= 0.98 * last);
    last = length;
    const double shorter = std::min(1.0, 0.3 * cloud.length / std::max(length, 1e-300));
    best.placed = recentred(moved(best.placed, per.cwiseProduct(Parameters(shorter * step.step))),
                            cloud.centroid);
  }
}

}  // namespace

ExtremeElement constrained_element(const Placed& gaussian, const PointCloud& cloud,
                                   bool material_inside, int max_iterations) {
  const Sides sides{.outer = material_inside, .inner = !material_inside};
  const double sign = material_inside ? 1.0 : -1.0;
  ExtremeElement out{.best = {.placed = gaussian}, .why = {}};
  ChosenPoints chosen(cloud);
  if (!chosen.all()) chosen.add(furthest(gaussian, cloud, sides), sides, -1e300);
  const double rounding = 2e-15 * cloud.length + 0.5 * cloud.rounding;
  for (int round = 0; round < 100; ++round) {
    search(out.best, cloud, chosen.cloud(), sign, max_iterations);
    const Furthest beyond = furthest(out.best.placed, cloud, sides);
    out.best.h = beyond.top;
    if (chosen.all() || !out.best.converged || beyond.top <= rounding) break;
    if (!chosen.add(beyond, sides, 0.0)) break;
  }
  for (Minimax::Contact& contact : out.best.contacts) contact.point = chosen.index(contact.point);
  out.best.gap = std::max(out.best.h, 0.0) + out.best.stationarity;
  return out;
}

}  // namespace trueaxis
