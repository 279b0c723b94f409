// SPDX-License-Identifier: Apache-2.0
#include "math/normal_mixture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trueaxis {
namespace {

double within(double q, double sd) { return std::erf(q / sd / std::sqrt(2.0)); }

TEST(NormalMixture, OfNormalsIsTheNormalOfTheirVariances) {
  EXPECT_NEAR(central_quantile(1.0, {}, 0.9545), 2.0, 0.003);
  const std::vector<NormalMixture> sure{{{1.0, 5.0, 3.0}}, {{1.0, -2.0, 4.0}}};
  EXPECT_NEAR(central_quantile(12.0, sure, 0.9545), 2.0 * 13.0, 0.03 * 1.3);
}

// For one mixture plus a normal P(|e| ≤ q) is a sum of error functions.
TEST(NormalMixture, OfOneThatIsSeldomThereIsTheQuantileOfTheSum) {
  for (const double sd : {1.0, 10.0, 100.0}) {
    const std::vector<NormalMixture> one{{{0.15, 0.0, sd}, {0.02, 0.0, 5.0 * sd}}};
    const double q = central_quantile(1.0, one, 0.9545);
    const double p = 0.83 * within(q, 1.0) + 0.15 * within(q, std::hypot(1.0, sd)) +
                     0.02 * within(q, std::hypot(1.0, 5.0 * sd));
    // The search ends within 0.1 % of q, and what is beyond 32 q counts as within it.
    EXPECT_NEAR(p, 0.9545, 3e-4) << sd;
  }
}

// About its mean: 0 or 1, each in half of the cases, is half off always.
TEST(NormalMixture, IsAboutTheMean) {
  const std::vector<NormalMixture> coin{{{0.5, 1.0, 0.0}}};
  const double q = central_quantile(0.01, coin, 0.5);
  EXPECT_NEAR(q, 0.5, 0.01);
}

}  // namespace
}  // namespace trueaxis
