// SPDX-License-Identifier: Apache-2.0
#include "math/statistics.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace trueaxis {

double mad_sigma(std::span<const double> residuals) {
  if (residuals.empty()) return 0.0;
  std::vector<double> size(residuals.size());
  std::ranges::transform(residuals, size.begin(), [](double r) { return std::abs(r); });
  static const double quartile = boost::math::quantile(boost::math::normal(), 0.75);
  return median(std::move(size)) / quartile;
}

double student_widening(double freedom, double coverage_factor) {
  constexpr double as_normal = 1000.0;
  if (!(freedom < as_normal)) return 1.0;
  const double above = cdf(complement(boost::math::normal(), coverage_factor));
  return quantile(complement(boost::math::students_t(freedom), above)) / coverage_factor;
}

std::optional<Jump> largest_jump(std::span<const double> values, double times) {
  std::vector<double> steps;
  Jump out;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i] - values[i - 1];
    if (!std::isfinite(step)) continue;
    steps.push_back(step);
    if (std::abs(step) > std::abs(out.size)) out.after = i, out.size = step;
  }
  if (steps.empty()) return {};
  out.usual = mad_sigma(steps);
  if (!(out.usual > 0.0) || std::abs(out.size) <= times * out.usual) return {};
  return out;
}

double neighbour_correlation(std::span<const double> residuals, double clip) {
  if (residuals.size() < 3) return 0.0;
  const auto n = static_cast<Eigen::Index>(residuals.size());
  const auto clipped = Eigen::Map<const Eigen::ArrayXd>(residuals.data(), n).max(-clip).min(clip);
  const double square = clipped.square().sum();
  return square > 0.0 ? (clipped.head(n - 1) * clipped.tail(n - 1)).sum() / square : 0.0;
}

DistinctValues distinct_values(std::vector<double> values) {
  constexpr double same = 1e-9, off = 0.02;  // below rounding of the values; of a step
  DistinctValues out;
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) return out;
  std::ranges::sort(values);
  double step = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double d = i > 0 ? values[i] - values[i - 1] : 0.0;
    out.count += i == 0 || d != 0.0;
    if (d > same && (step == 0.0 || d < step)) step = d;
  }
  if (step == 0.0) return out;
  const auto on = std::ranges::count_if(
      values, [&](double v) { return std::abs(std::remainder(v - values[0], step)) < off * step; });
  if (static_cast<std::size_t>(on) * 100 > 95 * values.size()) out.step = step;
  return out;
}

Extent range_of(std::span<const double> values) {
  const Eigen::Map<const Eigen::ArrayXd> all(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  return {all.minCoeff(), all.maxCoeff()};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
