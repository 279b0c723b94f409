// SPDX-License-Identifier: Apache-2.0
#include "math/normal_mixture.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr double ends_at = 6.0;  // sd t: e^{−18} is nothing
/// Steps to half a wave of sin(q t): what is beyond 32 q counts as if it were within.
constexpr double steps = 16.0;
constexpr double exact = 1e-3;

/// The characteristic function of the sum less its mean, at t.
double characteristic(double t, double sd, std::span<const NormalMixture> summands, double mean) {
  std::complex<double> product = std::exp(-0.5 * sd * sd * t * t) * std::polar(1.0, -mean * t);
  for (const NormalMixture& mixture : summands) {
    std::complex<double> sum = 1.0;
    for (const NormalPart& part : mixture) {
      const double size = part.probability * std::exp(-0.5 * part.sd * part.sd * t * t);
      sum += size * std::polar(1.0, part.mean * t) - part.probability;
    }
    product *= sum;
  }
  return product.real();
}

}  // namespace

double central_quantile(double sd, std::span<const NormalMixture> summands, double level) {
  expects(sd > 0.0, "a normal that has a width");
  double mean = 0.0;
  for (const NormalMixture& mixture : summands)
    for (const NormalPart& part : mixture) mean += part.probability * part.mean;
  // Steps of one size serve every smaller q too: the function at them is asked for once.
  double step = 0.0;
  std::vector<double> at_steps;
  const auto prepare = [&](double q) {
    step = std::numbers::pi / (steps * q);
    at_steps.clear();
    for (double t = step; t * sd < ends_at; t += step)
      at_steps.push_back(characteristic(t, sd, summands, mean) / t);
  };
  const auto within = [&](double q) {
    double sum = 0.5 * q, t = step;
    for (const double value : at_steps) {
      sum += std::sin(q * t) * value;
      t += step;
    }
    return 2.0 / std::numbers::pi * step * sum;
  };
  double low = sd, high = 1.5 * sd;
  for (prepare(high); within(high) < level; prepare(high)) low = high, high *= 1.5;
  while (high / low > 1.0 + exact) {
    const double middle = std::sqrt(low * high);
    (within(middle) < level ? low : high) = middle;
  }
  return high;
}

}  // namespace trueaxis
