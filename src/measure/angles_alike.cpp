// SPDX-License-Identifier: Apache-2.0
#include "measure/angles_alike.hpp"

#include <array>
#include <cmath>
#include <complex>

namespace trueaxis {

std::optional<int> angles_alike(const ProbeStream& stream) {
  constexpr int lowest = 3, highest = 100;
  constexpr double half = 0.5;
  if (stream.size() <= static_cast<std::size_t>(lowest)) return {};
  std::array<std::complex<double>, highest + 1> sums{};
  for (const double c : stream.c_rad) {
    const std::complex<double> turn = std::polar(1.0, c);
    std::complex<double> power = turn;
    for (std::size_t m = 2; m < sums.size(); ++m) sums[m] += power *= turn;
  }
  for (int m = lowest; m <= highest; ++m)
    if (std::abs(sums[static_cast<std::size_t>(m)]) > half * static_cast<double>(stream.size()))
      return m;
  return {};
}

}  // namespace trueaxis
