// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/spectrum.hpp"

#include <algorithm>
#include <complex>

#include "math/fourier_sums.hpp"

namespace trueaxis::diagnose_detail {

std::vector<SpectrumBin> spectrum_of(const LinearisationPoint& point, const Resolution& resolution,
                                     const std::vector<double>& before_mm,
                                     const std::vector<double>& after_mm) {
  constexpr double most_bins = 400.0;
  const double highest = std::min(15.0, 0.5 * resolution.per_turn);
  if (resolution.turns < 0.5 || highest < 1.0) return {};
  const double step = std::max(highest / most_bins, std::min(1.0, 0.5 / resolution.turns));
  const auto bins = static_cast<std::size_t>(highest / step) + 1;
  const FourierSums plan(point.c, 0.0, step, bins);
  const auto before = plan.of(before_mm), after = plan.of(after_mm);
  std::vector<SpectrumBin> out;
  for (std::size_t k = 0; k < bins; ++k) {
    const double factor = (k == 0 ? 1.0 : 2.0) / static_cast<double>(point.size());
    out.push_back(
        {step * static_cast<double>(k), factor * std::abs(before[k]), factor * std::abs(after[k])});
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail
