// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/math/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstddef>

namespace trueaxis {

double mad_sigma(std::span<const double> residuals) {
  if (residuals.empty()) return 0.0;
  std::vector<double> size(residuals.size());
  std::ranges::transform(residuals, size.begin(), [](double r) { return std::abs(r); });
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  static const double quartile = boost::math::quantile(boost::math::normal(), 0.75);
  return *middle / quartile;
}

double neighbour_correlation(std::span<const double> residuals, double clip) {
  if (residuals.size() < 3) return 0.0;
  double product = 0.0, square = 0.0, before = 0.0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double r = std::clamp(residuals[i], -clip, clip);
    square += r * r;
    if (i > 0) product += r * before;
    before = r;
  }
  return square > 0.0 ? product / square : 0.0;
}

}  // namespace trueaxis
