// SPDX-License-Identifier: Apache-2.0
// The fast transform in one step and in four.
#include "math/fast_fourier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// A line: x_j = exp(2πi jm/n) has X_m = n and nothing else.
TEST(FastFourier, LinesOfShortAndLongTransforms) {
  for (const std::size_t n : {2u, 30u, 6000u, 16384u, 16875u * 2u, 65536u}) {
    ASSERT_EQ(smooth_even_size(n), n);
    const FastFourier transform(n);
    FastFourier::Workspace workspace = transform.workspace();
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}, n / 3, n - 1}) {
      std::vector<double> real(n), imaginary(n);
      for (std::size_t j = 0; j < n; ++j) {
        const double angle = two_pi * static_cast<double>(j * m % n) / static_cast<double>(n);
        real[j] = std::cos(angle), imaginary[j] = std::sin(angle);
      }
      const auto sums = transform(real, imaginary, workspace);
      double worst = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double expected = k == m ? static_cast<double>(n) : 0.0;
        worst = std::max(worst, std::abs(sums[k] - expected));
      }
      // Rounding: a few ε for each of the log2 n ≤ 16 steps, times Σ|x| = n.
      EXPECT_LE(worst, 100.0 * std::numeric_limits<double>::epsilon() * static_cast<double>(n))
          << n << ' ' << m;
    }
  }
}

TEST(FastFourier, SmoothSizesAreTheSmallest) {
  for (std::size_t least = 1; least < 3000; ++least) {
    std::size_t expected = least + least % 2;
    const auto smooth = [](std::size_t n) {
      for (const std::size_t p : {2u, 3u, 5u}) {
        while (n % p == 0) n /= p;
      }
      return n == 1;
    };
    while (!smooth(expected)) expected += 2;
    EXPECT_EQ(smooth_even_size(least), expected) << least;
  }
}

}  // namespace
}  // namespace trueaxis
