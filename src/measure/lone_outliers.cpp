// SPDX-License-Identifier: Apache-2.0
#include "measure/lone_outliers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "math/statistics.hpp"

namespace trueaxis {

std::vector<bool> lone_outliers(std::span<const double> left_mm) {
  constexpr double far = 5.0;  // σ: of 1e6 readings of noise one
  std::vector<double> there;
  std::ranges::copy_if(left_mm, std::back_inserter(there),
                       [](double r) { return std::isfinite(r); });
  std::vector<bool> lone(left_mm.size(), false);
  if (there.empty()) return lone;
  const double limit_mm = far * mad_sigma(there);
  const auto is_far = [&](std::size_t i) { return std::abs(left_mm[i]) > limit_mm; };
  for (std::size_t i = 0; i < lone.size(); ++i)
    lone[i] = is_far(i) && !(i > 0 && is_far(i - 1)) && !(i + 1 < lone.size() && is_far(i + 1));
  return lone;
}

}  // namespace trueaxis
