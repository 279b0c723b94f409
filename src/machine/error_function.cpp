// SPDX-License-Identifier: Apache-2.0
#include "machine/error_function.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {
namespace {

ValueAndSlope evaluate(const ConstantError& error, double) { return {error.value, 0.0}; }

/// Horner's scheme of the sum and of its derivative.
ValueAndSlope evaluate(const PolynomialError& error, double position) {
  const double s = (position - error.origin) / error.scale;
  ValueAndSlope sum;
  for (std::size_t i = error.coefficients.size(); i-- > 0;) {
    sum.slope = sum.slope * s + sum.value;
    sum.value = sum.value * s + error.coefficients[i];
  }
  sum.slope /= error.scale;
  return sum;
}

ValueAndSlope evaluate(const FourierError& error, double position) {
  const double turn = two_pi / error.period;
  ValueAndSlope sum;
  for (const FourierError::Term& term : error.terms) {
    const double rate = turn * term.order, angle = rate * position;
    const double c = std::cos(angle), s = std::sin(angle);
    sum.value += term.cos * c + term.sin * s;
    sum.slope += rate * (term.sin * c - term.cos * s);
  }
  return sum;
}

ValueAndSlope evaluate(const TableError& error, double position) {
  const auto& at = error.at;
  if (at.empty()) return {};
  if (error.periodic && at.size() > 1) {
    const double length = at.back() - at.front();
    position -= length * std::floor((position - at.front()) / length);
  }
  const auto above = std::ranges::upper_bound(at, position);
  if (above == at.begin()) return {error.values.front(), 0.0};
  if (above == at.end()) return {error.values.back(), 0.0};
  const auto i = static_cast<std::size_t>(above - at.begin()) - 1;
  const double slope = (error.values[i + 1] - error.values[i]) / (at[i + 1] - at[i]);
  return {error.values[i] + slope * (position - at[i]), slope};
}

}  // namespace

ValueAndSlope value_and_slope(const ErrorFunction& function, double position) {
  return std::visit([&](const auto& kind) { return evaluate(kind, position); }, function);
}

double value_at(const ErrorFunction& function, double position) {
  return value_and_slope(function, position).value;
}

double ErrorModel::value(const ErrorName& name, const AxisPositions& axes) const {
  double sum = 0.0;
  for (const ErrorTerm& term : terms) {
    if (!(term.name == name)) continue;
    sum += value_at(term.function, name.body < axis_count ? axes[name.body] : 0.0);
  }
  return sum;
}

}  // namespace trueaxis
