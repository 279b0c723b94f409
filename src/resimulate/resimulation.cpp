// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/resimulation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <utility>

#include "math/fourier_sums.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_lines = 6;
constexpr double one_sided_1_percent = 2.326;  // Φ⁻¹(0.99)

/// Measured − simulated of the readings that count.
std::vector<double> difference(const ProbeStream& measured, const std::vector<double>& simulated_mm,
                               const std::vector<bool>& masked) {
  expects(simulated_mm.size() == measured.size(), "a simulated value for every reading");
  std::vector<double> out;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!masked[i]) out.push_back(measured.reading_mm[i] - simulated_mm[i]);
  }
  return out;
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

double mean_square(const std::vector<double>& values) {
  return values.empty() ? 0.0 : sum_of_squares(values) / static_cast<double>(values.size());
}

double variance(std::vector<double> values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, values.size()));
  for (double& value : values) value -= mean;
  return mean_square(values);
}

/// The recursion ε_i = e_i + Σ φ_j ε_{i−j} on values and, until it dies out, on zeros after them.
std::vector<double> responded(std::vector<double> values, const std::vector<double>& phi) {
  constexpr std::size_t longest = 4096;
  if (!phi.empty()) values.resize(values.size() + longest, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = 1; j <= std::min(phi.size(), i); ++j)
      values[i] += phi[j - 1] * values[i - j];
  }
  return values;
}

/// Σ d_i d_j ρ(i − j) with ρ the autocorrelation of the noise: Σ d_i ε_i in terms of the
/// innovations, which the recursion gives when it runs from the last reading to the first.
double correlated_squares(std::vector<double> d, const std::vector<double>& phi) {
  std::ranges::reverse(d);
  return sum_of_squares(responded(std::move(d), phi)) / sum_of_squares(responded({1.0}, phi));
}

/// Takes the mean of the readings that count off; the masked ones get 0.
void centre(std::vector<double>& values, const std::vector<bool>& masked) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (masked[i]) continue;
    sum += values[i];
    count += 1.0;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = masked[i] ? 0.0 : values[i] - sum / count;
}

Estimate j_test_lambda(const ProbeStream& measured, const SimulatedReadings& simulated,
                       const std::vector<bool>& masked, double sigma_mm,
                       const std::vector<double>& autoregression) {
  std::vector<double> way, left;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    way.push_back(simulated.before_mm[i] - simulated.after_mm[i]);
    left.push_back(measured.reading_mm[i] - simulated.after_mm[i]);
  }
  centre(way, masked);
  centre(left, masked);
  const double squares = sum_of_squares(way);
  if (!(squares > 0.0))
    return {std::nan(""), std::nan(""), "1", "the two simulations are the same"};
  const double product = std::inner_product(way.begin(), way.end(), left.begin(), 0.0);
  const double u = sigma_mm * std::sqrt(correlated_squares(way, autoregression)) / squares;
  return {product / squares, u, "1", ""};
}

std::vector<SpectrumBin> spectrum_of(const std::vector<double>& c_rad,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm) {
  constexpr double highest_order = 15.0, most_bins = 4000.0;
  double travel_rad = 0.0;
  for (std::size_t i = 1; i < c_rad.size(); ++i) travel_rad += std::abs(c_rad[i] - c_rad[i - 1]);
  const double turns = travel_rad / two_pi, count = static_cast<double>(c_rad.size());
  const double highest = turns > 0.0 ? std::min(highest_order, 0.5 * count / turns) : 0.0;
  if (turns < 0.5 || highest < 1.0) return {};
  // A whole number of steps to an order, so that harmonics are met.
  const double per_order = std::clamp(std::ceil(2.0 * turns), 1.0, std::floor(most_bins / highest));
  const auto bins = static_cast<std::size_t>(highest * per_order) + 1;
  const FourierSums sums(c_rad, 0.0, 1.0 / per_order, bins);
  const auto before = sums.of(before_mm), after = sums.of(after_mm);
  std::vector<SpectrumBin> out;
  for (std::size_t k = 0; k < bins; ++k) {
    const double factor = (k == 0 ? 1.0 : 2.0) / count;
    out.push_back({static_cast<double>(k) / per_order, factor * std::abs(before[k]),
                   factor * std::abs(after[k])});
  }
  return out;
}

double height(const SpectrumBin& bin) { return std::max(bin.before_mm, bin.after_mm); }

/// The highest bins, each the top of what it can leak into.
std::vector<SpectrumBin> largest_lines(const std::vector<SpectrumBin>& spectrum) {
  constexpr std::ptrdiff_t side_lobes = 3;  // half cells to either side
  std::vector<SpectrumBin> lines;
  for (auto bin = spectrum.begin(); bin != spectrum.end(); ++bin) {
    const auto low = bin - std::min(side_lobes, bin - spectrum.begin());
    const auto high = bin + std::min(side_lobes, spectrum.end() - bin - 1);
    if (std::ranges::max_element(low, high + 1, {}, height) == bin) lines.push_back(*bin);
  }
  std::ranges::stable_sort(lines, std::greater{}, height);
  if (lines.size() > most_lines) lines.resize(most_lines);
  return lines;
}

}  // namespace

Comparison compare(const ProbeStream& measured, const SimulatedReadings& simulated,
                   const std::vector<bool>& masked, double sigma_mm,
                   const std::vector<double>& autoregression) {
  expects(masked.size() == measured.size(), "a mark for every reading");
  const std::vector<double> before = difference(measured, simulated.before_mm, masked);
  const std::vector<double> after = difference(measured, simulated.after_mm, masked);
  Comparison out;
  out.readings = before.size();
  out.masked = measured.size() - before.size();
  const double whole = variance(before);
  const auto share = [&](double part) { return whole > 0.0 ? part / whole : std::nan(""); };
  out.before = {std::sqrt(mean_square(before)), share(whole)};
  out.after = {std::sqrt(mean_square(after)), share(variance(after))};
  out.noise = {sigma_mm, share(sigma_mm * sigma_mm)};
  out.j_test_lambda = j_test_lambda(measured, simulated, masked, sigma_mm, autoregression);
  std::vector<double> c_rad;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!masked[i]) c_rad.push_back(measured.c_rad[i]);
  }
  out.spectrum = spectrum_of(c_rad, before, after);
  out.lines = largest_lines(out.spectrum);
  return out;
}

bool refuted(const Comparison& comparison) {
  const Estimate& back = comparison.j_test_lambda;
  return back.value > std::max(0.5, one_sided_1_percent * back.u);
}

}  // namespace trueaxis
