// SPDX-License-Identifier: Apache-2.0
#include "measure/sideways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"

namespace trueaxis {

Sideways sideways_of(std::span<const double> c_rad, std::span<const double> z_mm,
                     std::span<const double> off_mm) {
  Sideways out{0.0, std::numeric_limits<double>::infinity()};
  const auto count = static_cast<Eigen::Index>(off_mm.size());
  if (count <= 4) return out;
  const auto [least, most] = std::ranges::minmax(z_mm);
  const double length = most > least ? most - least : 1.0;
  linear::MatrixXd a(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    a.row(i) << std::cos(c_rad[k]), std::sin(c_rad[k]), 1.0, (z_mm[k] - least) / length;
  }
  const Eigen::Map<const linear::VectorXd> off(off_mm.data(), count);
  const linear::ShortestSolution fit = linear::shortest_solution(a, off);
  if (fit.rank < (most > least ? 4 : 3)) return out;
  out.size_mm = fit.x.head(2).norm();
  const double sigma = std::sqrt((off - a * fit.x).squaredNorm() / static_cast<double>(count - 4));
  out.u_mm = sigma * fit.pseudo_inverse.topRows(2).rowwise().norm().maxCoeff();
  return out;
}

}  // namespace trueaxis
