// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "fit/describe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

void add_apex_interval(std::vector<FitParameter>& parameters, const Covariance& covariance,
                       double coverage_factor) {
  const auto apex = std::ranges::find(parameters, "k", &FitParameter::name),
             angle = std::ranges::find(parameters, "half_angle", &FitParameter::name);
  if (apex == parameters.end() || angle == parameters.end()) return;
  Estimate& k = apex->estimate;
  k.interval.reset();
  if (!k.determined() || !std::isfinite(k.u)) return;
  const auto row = static_cast<std::size_t>(apex - parameters.begin()),
             column = static_cast<std::size_t>(angle - parameters.begin());
  const double half_angle_rad = angle->estimate.value;
  // ∂ ln tan α/∂α in rad: what is wanted of tan α are its covariances relative to itself.
  const double relative = 2.0 / std::sin(2.0 * half_angle_rad);
  const double with_tan = relative * covariance(row, column);
  const double squared = coverage_factor * coverage_factor;
  const double left = 1.0 - squared * std::pow(relative * angle->estimate.u, 2);
  if (!(left > 0.0)) return;
  const double middle = -squared * with_tan / left;
  const double half = std::sqrt(middle * middle + squared * k.u * k.u / left);
  k.interval = {k.value + middle - half, k.value + middle + half};
}

}  // namespace trueaxis
