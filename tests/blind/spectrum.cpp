// SPDX-License-Identifier: Apache-2.0
#include "blind/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trueaxis::blind {

std::vector<double> strongest_lines(const Eigen::VectorXd& values, const Eigen::VectorXd& x,
                                    const Eigen::VectorXd& offset_rad, Band band,
                                    std::size_t most) {
  const double range = x.maxCoeff() - x.minCoeff();
  if (!(range > 0.0)) return {};
  const double bin = 2.0 * std::numbers::pi / range, step = bin / 8.0;
  const auto count = static_cast<Eigen::Index>((band.high - band.low) / step) + 1;
  // Phasors that a complex multiplication turns from one frequency to the next.
  const Eigen::ArrayXd at = band.low * x.array() + offset_rad.array(), by = step * x.array();
  Eigen::ArrayXd re = values.array() * at.cos(), im = values.array() * at.sin();
  const Eigen::ArrayXd cosine = by.cos(), sine = by.sin();
  Eigen::ArrayXd next(re.size());
  std::vector<std::pair<double, double>> lines;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double real = re.sum(), imaginary = im.sum();
    lines.emplace_back(real * real + imaginary * imaginary,
                       band.low + step * static_cast<double>(k));
    next = re * cosine - im * sine;
    im = re * sine + im * cosine;
    re = next;
  }
  std::ranges::sort(lines, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<double> found;
  for (const auto& [power, w] : lines) {
    if (found.size() == most) break;
    const auto near = [&](double other) { return std::abs(other - w) < bin; };
    if (std::ranges::none_of(found, near)) found.push_back(w);
  }
  return found;
}

}  // namespace trueaxis::blind
