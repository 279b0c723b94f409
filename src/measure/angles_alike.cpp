// SPDX-License-Identifier: Apache-2.0
#include "measure/angles_alike.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "trueaxis/units.hpp"

namespace trueaxis {

std::optional<int> angles_alike(const ProbeStream& stream) {
  constexpr int lowest = 3, highest = 100;
  constexpr double half = 0.5;
  constexpr double standstill_rad = 1e-4;
  constexpr std::size_t bins = 32768;
  if (stream.size() <= static_cast<std::size_t>(lowest)) return {};
  std::array<std::complex<double>, highest + 1> sums{};
  const auto add = [&](double c, double readings) {
    const std::complex<double> turn = std::polar(1.0, c);
    std::complex<double> power = readings * turn;
    for (std::size_t m = 2; m < sums.size(); ++m) sums[m] += power *= turn;
  };
  // Readings of a spindle that stands still are one.
  std::vector<double> moved;
  for (const double c : stream.c_rad)
    if (moved.empty() || std::abs(c - moved.back()) > standstill_rad) moved.push_back(c);
  if (moved.size() < bins) {
    for (const double c : moved) add(c, 1.0);
  } else {  // many readings share an angle to within 0.01°: at the highest order 1.1° of phase
    std::vector<double> count(bins);
    for (const double c : moved) {
      const double turns = c / two_pi;
      ++count[static_cast<std::size_t>((turns - std::floor(turns)) * bins) % bins];
    }
    for (std::size_t bin = 0; bin < bins; ++bin)
      if (count[bin] > 0.0) add(two_pi * (static_cast<double>(bin) + 0.5) / bins, count[bin]);
  }
  for (int m = lowest; m <= highest; ++m)
    if (std::abs(sums[static_cast<std::size_t>(m)]) > half * static_cast<double>(moved.size()))
      return m;
  return {};
}

}  // namespace trueaxis
