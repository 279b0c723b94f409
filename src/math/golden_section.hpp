// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trueaxis {

inline constexpr double golden_ratio = 0.6180339887498949;

/// The k-th of a sequence that is dense in 0 to 1 wherever it ends, and has no period.
inline double golden_share(std::size_t k) {
  return std::fmod(golden_ratio * static_cast<double>(k), 1.0);
}

/// Where a function of one maximum has it, to 0.618ⁿ of the range after n steps (Kiefer 1953).
struct GoldenSection {
  double low, high;  ///< between which it lies
  double largest;    ///< of the values that were met last
};

template <typename Function>
GoldenSection golden_section(const Function& f, double low, double high, int steps) {
  constexpr double golden = golden_ratio;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < steps; ++i) {
    if (fa > fb) {
      high = b, b = a, fb = fa, a = high - golden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb, b = low + golden * (high - low), fb = f(b);
    }
  }
  return {low, high, std::max(fa, fb)};
}

}  // namespace trueaxis
