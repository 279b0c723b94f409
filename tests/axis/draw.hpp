// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace trueaxis::axis {

/// Numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random(seed * 0x9E3779B97F4A7C15ULL + 1) {}
  double unit() { return static_cast<double>(random() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) {
    return low + static_cast<int>(unit() * static_cast<double>(high - low + 1));
  }
  double phase() { return between(-std::numbers::pi, std::numbers::pi); }

  std::mt19937_64 random;
};

}  // namespace trueaxis::axis
