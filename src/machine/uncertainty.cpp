// SPDX-License-Identifier: Apache-2.0
#include "machine/uncertainty.hpp"

#include <algorithm>
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

void add_covariance(ErrorCovariance& all, const ErrorCovariance& more) {
  std::vector<std::size_t> places;
  std::vector<UncertainAmount> amounts = all.names();
  for (const UncertainAmount& amount : more.names()) {
    const auto found = std::ranges::find(amounts, amount);
    places.push_back(static_cast<std::size_t>(found - amounts.begin()));
    if (found == amounts.end()) amounts.push_back(amount);
  }
  ErrorCovariance sum(std::move(amounts));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) sum(i, j) = all(i, j);
  for (std::size_t i = 0; i < more.size(); ++i)
    for (std::size_t j = 0; j < more.size(); ++j) sum(places[i], places[j]) += more(i, j);
  all = std::move(sum);
}

void gather_uncertainty(ErrorModel& errors) {
  ErrorCovariance& covariance = errors.covariance;
  for (ErrorTerm& term : errors.terms) {
    const auto at = covariance.find(UncertainAmount{.name = term.name});
    if (term.u == 0.0 || !at) continue;
    covariance(*at, *at) += term.u * term.u;
    term.u = 0.0;
  }
}

}  // namespace trueaxis
