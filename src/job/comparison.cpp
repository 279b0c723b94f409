// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/job/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "trueaxis/base/error.hpp"
#include "trueaxis/base/units.hpp"
#include "trueaxis/math/fourier_sums.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_lines = 6;

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

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double v : values) squares += v * v;
  return values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
}

double variance(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const double count = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  for (const double v : values) squares += (v - sum / count) * (v - sum / count);
  return squares / count;
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
                   const std::vector<bool>& masked, double sigma_mm) {
  expects(masked.size() == measured.size(), "a mark for every reading");
  const std::vector<double> before = difference(measured, simulated.before_mm, masked);
  const std::vector<double> after = difference(measured, simulated.after_mm, masked);
  Comparison out;
  out.readings = before.size();
  out.masked = measured.size() - before.size();
  const double whole = variance(before);
  const auto share = [&](double part) { return whole > 0.0 ? part / whole : std::nan(""); };
  out.before = {rms(before), share(whole)};
  out.after = {rms(after), share(variance(after))};
  out.noise = {sigma_mm, share(sigma_mm * sigma_mm)};
  std::vector<double> c_rad;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!masked[i]) c_rad.push_back(measured.c_rad[i]);
  }
  out.spectrum = spectrum_of(c_rad, before, after);
  out.lines = largest_lines(out.spectrum);
  return out;
}

}  // namespace trueaxis
