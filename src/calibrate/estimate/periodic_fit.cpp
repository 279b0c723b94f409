// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/periodic_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <complex>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

PeriodicFit::PeriodicFit(std::vector<double> position, std::vector<double> value,
                         std::size_t smooth, std::vector<double> sense)
    : position_(std::move(position)),
      value_(std::move(value)),
      sense_(std::move(sense)),
      smooth_(std::min(smooth, std::clamp<std::size_t>(position_.size() / 3, 2, 4))) {}

std::vector<int> PeriodicFit::orders_up_to(int most, double period,
                                           double highest_frequency) const {
  const auto room = static_cast<int>(position_.size() / 6);
  std::vector<int> orders;
  for (int n = 1; n <= std::min(most, room) && n / period <= highest_frequency; ++n)
    orders.push_back(n);
  return orders;
}

PeriodicFit::Result PeriodicFit::with(const std::vector<int>& orders, double period) const {
  const auto n = static_cast<Index>(position_.size()), smooth = static_cast<Index>(smooth_);
  const auto waves = static_cast<Index>(first_order());
  const Index columns = waves + 2 * static_cast<Index>(orders.size());
  const Extent range = range_of(position_);
  MatrixXd design(n, columns);
  for (Index i = 0; i < n; ++i) {
    const double q = position_[static_cast<std::size_t>(i)];
    const double s = (2.0 * q - range.low - range.high) / range.length();
    const double basis[] = {1.0, s, 1.5 * s * s - 0.5, (2.5 * s * s - 1.5) * s};
    for (Index k = 0; k < smooth; ++k) design(i, k) = basis[k];
    if (has_senses()) design(i, smooth) = sense_[static_cast<std::size_t>(i)];
    const std::complex<double> first =
        std::polar(1.0, two_pi * (orders.empty() ? 0.0 : q / period));
    std::complex<double> power = 1.0;
    int at = 0;
    for (std::size_t k = 0; k < orders.size(); ++k) {
      for (; at < orders[k]; ++at) power *= first;
      design(i, waves + 2 * static_cast<Index>(k)) = power.real();
      design(i, waves + 2 * static_cast<Index>(k) + 1) = power.imag();
    }
  }
  const VectorXd y = Eigen::Map<const VectorXd>(value_.data(), n);
  const MatrixXd normal = linear::gram(design);
  const VectorXd x = linear::solve_normal(normal, linear::transposed_product(design, y));
  const VectorXd residuals = y - design * x;
  const MatrixXd inverse = linear::inverse_of_normal(normal);
  Result out;
  out.rss = residuals.squaredNorm();
  out.freedom = static_cast<double>(n - columns);
  out.residuals.assign(residuals.begin(), residuals.end());
  const double variance = out.rss / std::max(1.0, out.freedom);
  for (Index k = 0; k < columns; ++k) {
    out.coefficients.push_back(x[k]);
    out.u.push_back(std::sqrt(variance * inverse(k, k)));
  }
  for (Index k = waves; k < columns; k += 2) {
    const Eigen::Vector2d pair = x.segment<2>(k);
    out.gains.push_back(pair.dot(inverse.block<2, 2>(k, k).inverse() * pair));
  }
  return out;
}

}  // namespace trueaxis::calibrate_detail
