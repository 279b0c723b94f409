// SPDX-License-Identifier: Apache-2.0
#include "form/regression_rows.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/linear_algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::form {
namespace {

/// Widths of the kernel to either side; the weight there is exp(−π 2.2²) = 2.5e-7.
constexpr double reach = 2.2;
/// A system of moments that is nearer to singular than this is one of a lower degree.
constexpr double least_determinant = 1e-9;

/// a of the polynomial Σ a_k d^k that times the weights keeps the moments: M a = e₀. Eq. 261.
std::array<double, 3> moment_solution(const std::array<double, 5>& m, int degree) {
  if (degree == 2) {
    Eigen::Matrix3d moments;
    moments << m[0], m[1], m[2], m[1], m[2], m[3], m[2], m[3], m[4];
    if (moments.determinant() > least_determinant * m[0] * m[2] * m[4]) {
      const Eigen::Vector3d a =
          linear::solve_normal(moments, Eigen::Vector3d(Eigen::Vector3d::UnitX()));
      return {a[0], a[1], a[2]};
    }
  }
  const double determinant = m[0] * m[2] - m[1] * m[1];
  if (degree >= 1 && determinant > least_determinant * m[0] * m[2])
    return {m[2] / determinant, -m[1] / determinant, 0.0};
  return {1.0 / m[0], 0.0, 0.0};
}

}  // namespace

RegressionRows::RegressionRows(const Trace& trace, const Kernel& kernel,
                               std::span<const double> weight)
    : count_(trace.size()), closed_(trace.closed()) {
  expects(weight.size() == count_, "a weight for every reading");
  if (closed_)
    for (const double place : trace.at) places_.push_back(place - trace.period);
  places_.insert(places_.end(), trace.at.begin(), trace.at.end());
  if (closed_)
    for (const double place : trace.at) places_.push_back(place + trace.period);
  for (const double at : trace.at) add_row(at, kernel, weight);
  begin_.push_back(weights_.size());
}

void RegressionRows::add_row(double at, const Kernel& kernel, std::span<const double> weight) {
  const double half = reach * kernel.width;
  auto low =
      static_cast<std::size_t>(std::ranges::lower_bound(places_, at - half) - places_.begin());
  auto high =
      static_cast<std::size_t>(std::ranges::upper_bound(places_, at + half) - places_.begin());
  const auto distance = [&](std::size_t j) { return (places_[j] - at) / kernel.width; };
  const auto gauss = [&](std::size_t j) {
    const double d = distance(j);
    return std::exp(-std::numbers::pi * d * d);
  };
  std::array<double, 5> moments{};
  for (std::size_t j = low; j < high; ++j) {
    double term = weight[j % count_] * gauss(j);
    for (double& moment : moments) {
      moment += term;
      term *= distance(j);
    }
  }
  begin_.push_back(weights_.size());
  first_.push_back(low);
  if (!(moments[0] > 0.0)) {  // a robust filter has left nothing here: the shares alone
    const double even = 1.0 / static_cast<double>(high - low);
    weights_.insert(weights_.end(), high - low, even);
    return;
  }
  const auto a = moment_solution(moments, kernel.degree);
  for (std::size_t j = low; j < high; ++j) {
    const double d = distance(j);
    weights_.push_back(weight[j % count_] * gauss(j) * (a[0] + d * (a[1] + d * a[2])));
  }
}

std::vector<double> RegressionRows::operator()(std::span<const double> value_mm) const {
  expects(value_mm.size() == count_, "a value for every place");
  std::vector<double> all;
  for (int turn = 0; turn < (closed_ ? 3 : 1); ++turn)
    all.insert(all.end(), value_mm.begin(), value_mm.end());
  std::vector<double> out(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto length = static_cast<Eigen::Index>(begin_[i + 1] - begin_[i]);
    out[i] = Eigen::Map<const Eigen::VectorXd>(weights_.data() + begin_[i], length)
                 .dot(Eigen::Map<const Eigen::VectorXd>(all.data() + first_[i], length));
  }
  return out;
}

}  // namespace trueaxis::form
