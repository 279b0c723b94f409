// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "trueaxis/surface.hpp"

namespace trueaxis {

double AxisEstimate::u_at(double z_mm) const {
  const double lever = z_mm - axis.z_ref_mm;
  // Covariance of (x + lever·slope_x, y + lever·slope_y).
  const auto propagated = [&](int i, int j) {
    const auto cov = [&](int row, int column) {
      return covariance[static_cast<std::size_t>(4 * row + column)];
    };
    return cov(i, j) + lever * (cov(i, j + 2) + cov(i + 2, j)) + lever * lever * cov(i + 2, j + 2);
  };
  const double xx = propagated(0, 0), yy = propagated(1, 1);
  const double xy = 0.5 * (propagated(0, 1) + propagated(1, 0));
  const double largest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(largest, 0.0));  // in this order NaN stays NaN: no u is not u = 0
}

}  // namespace trueaxis
