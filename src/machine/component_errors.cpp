// SPDX-License-Identifier: Apache-2.0
#include "machine/component_errors.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/machine.hpp"

namespace trueaxis {
namespace {

struct ValueAndSlope {
  double value = 0.0, slope = 0.0;  ///< slope: per mm or rad of the position
};

/// cos and sin of 2πq/P at one position q, kept from one Fourier sum to the next of its period.
struct FirstWave {
  double period = 0.0;  ///< 0: none yet
  double cos = 1.0, sin = 0.0;
};

/// What is wanted of a function at a position.
struct Asked {
  double position;
  FirstWave& wave;
};

template <bool slopes>
ValueAndSlope evaluate(const ConstantError& error, const Asked&) {
  return {error.value, 0.0};
}

/// Horner's scheme of the sum and of its derivative.
template <bool slopes>
ValueAndSlope evaluate(const PolynomialError& error, const Asked& asked) {
  const double s = (asked.position - error.origin) / error.scale;
  ValueAndSlope sum;
  for (std::size_t i = error.coefficients.size(); i-- > 0;) {
    if (slopes) sum.slope = sum.slope * s + sum.value;
    sum.value = sum.value * s + error.coefficients[i];
  }
  if (slopes) sum.slope /= error.scale;
  return sum;
}

/// cos and sin of whole multiples of an angle, by rotating on from one to the next: half an ulp a
/// step, and a fraction of the time of calling sin and cos again.
struct Harmonics {
  explicit Harmonics(const FirstWave& first)
      : c1(first.cos), s1(first.sin), c(first.cos), s(first.sin) {}
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

template <bool slopes>
ValueAndSlope evaluate(const FourierError& error, const Asked& asked) {
  constexpr double stepwise = 16.0;  // whole orders up to here
  const double turn = two_pi / error.period;
  if (asked.wave.period != error.period) {
    const double angle = turn * asked.position;
    asked.wave = {error.period, std::cos(angle), std::sin(angle)};
  }
  Harmonics at(asked.wave);
  ValueAndSlope sum;
  for (const FourierError::Term& term : error.terms) {
    const double rate = turn * term.order;
    double c = 0.0, s = 0.0;
    if (term.order >= 0.0 && term.order <= stepwise && std::floor(term.order) == term.order) {
      at.go_to(static_cast<int>(term.order));
      c = at.c, s = at.s;
    } else {
      c = std::cos(rate * asked.position), s = std::sin(rate * asked.position);
    }
    sum.value += term.cos * c + term.sin * s;
    if (slopes) sum.slope += rate * (term.sin * c - term.cos * s);
  }
  return sum;
}

/// The piece of a table in which a position lies, ends not among them: the points of most tables
/// are even, so that a proportion finds it.
std::size_t piece_of(const std::vector<double>& at, double position) {
  const double share = (position - at.front()) / (at.back() - at.front());
  const std::size_t last = at.size() - 2;
  const auto i = std::min(static_cast<std::size_t>(share * static_cast<double>(last + 1)), last);
  if (at[i] <= position && position < at[i + 1]) return i;
  return static_cast<std::size_t>(std::ranges::upper_bound(at, position) - at.begin()) - 1;
}

template <bool slopes>
ValueAndSlope evaluate(const TableError& error, const Asked& asked) {
  const auto& at = error.at;
  double position = asked.position;
  if (at.empty()) return {};
  if (error.periodic && at.size() > 1) {
    const double length = at.back() - at.front();
    position -= length * std::floor((position - at.front()) / length);
  }
  if (position < at.front()) return {error.values.front(), 0.0};
  if (!(position < at.back())) return {error.values.back(), 0.0};
  const std::size_t i = piece_of(at, position);
  const double slope = (error.values[i + 1] - error.values[i]) / (at[i + 1] - at[i]);
  return {error.values[i] + slope * (position - at[i]), slope};
}

/// `value_at` with its derivative; at a corner of a table that of the piece above it.
/// @param wave of this position
ValueAndSlope value_and_slope(const ErrorFunction& function, double position, FirstWave& wave) {
  return std::visit(
      [asked = Asked{position, wave}](const auto& kind) { return evaluate<true>(kind, asked); },
      function);
}

double value_at(const ErrorFunction& function, double position, FirstWave& wave) {
  return std::visit([asked = Asked{position, wave}](
                        const auto& kind) { return evaluate<false>(kind, asked).value; },
                    function);
}

double& entry(ComponentErrors& errors, std::size_t direction) {
  return direction < 3 ? errors.shift[static_cast<Eigen::Index>(direction)]
                       : errors.rotation[static_cast<Eigen::Index>(direction - 3)];
}

}  // namespace

double value_at(const ErrorFunction& function, double position) {
  FirstWave wave;
  return value_at(function, position, wave);
}

double ErrorModel::value(const ErrorName& name, const AxisPositions& axes) const {
  double sum = 0.0;
  for (const ErrorTerm& term : terms) {
    if (!(term.name == name)) continue;
    sum += value_at(term.function, name.body < axis_count ? axes[name.body] : 0.0);
  }
  return sum;
}

rigid::Motion ComponentErrors::motion(const Joint& joint) const {
  rigid::Motion e{Eigen::Matrix3d::Identity(), shift};
  if (!joint.turns) {
    if (joint.inverted) e.t = -shift;
    return e;
  }
  e.R = rigid::exponential(rotation);
  if (joint.inverted) e = e.inverse();
  return rigid::about(joint.actual_pivot, e.R, e.t);
}

ComponentErrors component_errors(const Joint& joint, double position) {
  ComponentErrors errors;
  FirstWave wave;
  for (const Joint::Component& one : joint.components)
    entry(errors, one.direction) += value_at(one.function, position, wave);
  return errors;
}

ComponentErrorsAndSlopes component_errors_and_slopes(const Joint& joint, double position) {
  ComponentErrorsAndSlopes both;
  FirstWave wave;
  for (const Joint::Component& one : joint.components) {
    const ValueAndSlope at = value_and_slope(one.function, position, wave);
    entry(both.errors, one.direction) += at.value;
    entry(both.slopes, one.direction) += at.slope;
  }
  return both;
}

}  // namespace trueaxis
