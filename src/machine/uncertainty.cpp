// SPDX-License-Identifier: Apache-2.0
#include "machine/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueaxis {

using Eigen::Index;
using Eigen::MatrixXd;

// (k + 1) P_{k+1} = (2k + 1) s P_k − k P_{k−1}
PolynomialError legendre(int degree, double low, double high) {
  std::vector<double> before{}, now{1.0};
  for (int k = 0; k < degree; ++k) {
    std::vector<double> next(now.size() + 1, 0.0);
    for (std::size_t i = 0; i < now.size(); ++i)
      next[i + 1] += (2.0 * k + 1.0) / (k + 1.0) * now[i];
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= k / (k + 1.0) * before[i];
    before = std::exchange(now, std::move(next));
  }
  return {now, 0.5 * (low + high), 0.5 * (high - low)};
}

ErrorFunction UncertainAmount::unit() const {
  const auto n = static_cast<double>(order);
  switch (shape) {
    case Shape::legendre:
      return legendre(order, low, high);
    case Shape::cosine:
      return FourierError{{{n, 1.0, 0.0}}, high - low};
    case Shape::sine:
      return FourierError{{{n, 0.0, 1.0}}, high - low};
    case Shape::constant:
      break;
  }
  return ConstantError{1.0};
}

std::string to_string(const UncertainAmount& amount) {
  constexpr const char* shapes[] = {"", ".poly", ".cos", ".sin"};
  const auto shape = static_cast<std::size_t>(amount.shape);
  std::string text = to_string(amount.name) + shapes[shape];
  return shape == 0 ? text : text + std::to_string(amount.order);
}

MatrixXd matrix_of(const ErrorCovariance& covariance) {
  const auto n = static_cast<Index>(covariance.amounts.size());
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      covariance.matrix.data(), n, n);
}

void add_covariance(ErrorCovariance& all, const ErrorCovariance& more) {
  std::vector<std::size_t> places;
  std::vector<UncertainAmount> amounts = all.amounts;
  for (const UncertainAmount& amount : more.amounts) {
    const auto found = std::ranges::find(amounts, amount);
    places.push_back(static_cast<std::size_t>(found - amounts.begin()));
    if (found == amounts.end()) amounts.push_back(amount);
  }
  const std::size_t n = amounts.size(), before = all.amounts.size(), added = more.amounts.size();
  std::vector<double> matrix(n * n, 0.0);
  for (std::size_t i = 0; i < before; ++i)
    for (std::size_t j = 0; j < before; ++j) matrix[i * n + j] = all.matrix[i * before + j];
  for (std::size_t i = 0; i < added; ++i)
    for (std::size_t j = 0; j < added; ++j)
      matrix[places[i] * n + places[j]] += more.matrix[i * added + j];
  all = {std::move(amounts), std::move(matrix)};
}

void gather_uncertainty(ErrorModel& errors) {
  ErrorCovariance& covariance = errors.covariance;
  for (ErrorTerm& term : errors.terms) {
    const auto found = std::ranges::find(covariance.amounts, UncertainAmount{.name = term.name});
    if (term.u == 0.0 || found == covariance.amounts.end()) continue;
    const auto at = static_cast<std::size_t>(found - covariance.amounts.begin());
    covariance.matrix[at * (covariance.amounts.size() + 1)] += term.u * term.u;
    term.u = 0.0;
  }
}

}  // namespace trueaxis
