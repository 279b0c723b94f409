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

/// cos and sin of whole multiples of an angle, by rotating on from one to the next: half an ulp a
/// step, and a fraction of the time of calling sin and cos again.
struct Harmonics {
  explicit Harmonics(double angle) : c1(std::cos(angle)), s1(std::sin(angle)), c(c1), s(s1) {}
  void go_to(int wanted) {
    if (wanted < order) c = 1.0, s = 0.0, order = 0;
    for (; order < wanted; ++order) {
      const double next = c * c1 - s * s1;
      s = s * c1 + c * s1;
      c = next;
    }
  }
  double c1, s1, c, s;
  int order = 1;
};

ValueAndSlope evaluate(const FourierError& error, double position) {
  constexpr double stepwise = 16.0;  // whole orders up to here
  const double turn = two_pi / error.period;
  Harmonics at(turn * position);
  ValueAndSlope sum;
  for (const FourierError::Term& term : error.terms) {
    const double rate = turn * term.order;
    double c = 0.0, s = 0.0;
    if (term.order >= 0.0 && term.order <= stepwise && std::floor(term.order) == term.order) {
      at.go_to(static_cast<int>(term.order));
      c = at.c, s = at.s;
    } else {
      c = std::cos(rate * position), s = std::sin(rate * position);
    }
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
