// SPDX-License-Identifier: Apache-2.0
#include "math/exponential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trueaxis {
namespace {

// Highway's Exp is stated to 1 ulp, the library's to less: 2 ε together.
TEST(Exponential, IsThatOfTheLibraryAtAnyLengthAndPlace) {
  for (std::size_t count = 0; count <= 17; ++count) {
    for (const double step : {0.013, 1.7, 37.0}) {
      std::vector<double> power(count), out(count);
      for (std::size_t i = 0; i < count; ++i) power[i] = 2.0 - step * static_cast<double>(i);
      exponential(power, out);
      for (std::size_t i = 0; i < count; ++i)
        EXPECT_NEAR(out[i], std::exp(power[i]),
                    2.0 * std::numeric_limits<double>::epsilon() * std::exp(power[i]));
      exponential(power, power);
      EXPECT_EQ(power, out);
    }
  }
  std::vector<double> far{-1e6, -750.0};
  exponential(far, far);
  for (const double value : far) EXPECT_LE(std::abs(value), std::numeric_limits<double>::min());
}

}  // namespace
}  // namespace trueaxis
