// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "form/low_pass.hpp"
#include "form/regression_rows.hpp"
#include "math/statistics.hpp"

namespace trueaxis::form {
namespace {

/// α of ISO 16610-21: exp(−π α²) = 1/2.
const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
/// γ of the regression of second degree, (1 + π γ²) exp(−π γ²) = 1/2 (ISO 16610-31: 0.7309).
constexpr double gamma_of_second_degree = 0.7309134280946759;
/// 3 σ of Gaussian readings in medians of their absolute values.
constexpr double medians_to_cut = 4.4478;
constexpr int most_reweightings = 100;
constexpr double cut_settled = 1e-5;

}  // namespace

double longest_step(double cutoff) { return 0.5 * cutoff; }

double gaussian_transmission(double cutoff, double wavelength) {
  const double f = alpha * cutoff / wavelength;
  return std::exp(-std::numbers::pi * f * f);
}

double robust_transmission(double cutoff, double wavelength) {
  const double f = gamma_of_second_degree * cutoff / wavelength, u = std::numbers::pi * f * f;
  return (1.0 + u) * std::exp(-u);
}

std::unique_ptr<LowPass> gaussian_low_pass(const Trace& trace, double cutoff) {
  return std::make_unique<RegressionRows>(trace, RegressionRows::Kernel{alpha * cutoff, 1},
                                          shares_of(trace, longest_step(cutoff)));
}

std::unique_ptr<LowPass> robust_low_pass(const Trace& trace, double cutoff) {
  const RegressionRows::Kernel kernel{gamma_of_second_degree * cutoff, 2};
  const std::vector<double> shares = shares_of(trace, longest_step(cutoff));
  auto rows = std::make_unique<RegressionRows>(trace, kernel, shares);
  double before = 0.0;
  for (int round = 0; round < most_reweightings; ++round) {
    std::vector<double> off = (*rows)(trace.value_mm);
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = std::abs(trace.value_mm[i] - off[i]);
    const double cut = medians_to_cut * median(off);
    if (!(cut > 0.0) || std::abs(cut - before) <= cut_settled * cut) break;
    before = cut;
    std::vector<double> weight(shares);
    for (std::size_t i = 0; i < off.size(); ++i) {
      const double t = off[i] / cut;
      weight[i] *= t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0;
    }
    rows = std::make_unique<RegressionRows>(trace, kernel, weight);
  }
  return rows;
}

}  // namespace trueaxis::form
