// SPDX-License-Identifier: Apache-2.0
// Which measurement to take next: by the contract, of made-up probabilities.
#include <gtest/gtest.h>

#include <array>

#include "infer/advice.hpp"

namespace trueaxis::infer {
namespace {

const std::array<Measure, 3> plans{{{"slow", "", 30.0}, {"fast", "", 5.0}, {"weak", "", 1.0}}};

Separating chosen(const std::vector<double>& after, double sure = 0.9) {
  return choose(plans, 0.5, after, sure, "nothing tells them apart");
}

TEST(InferAdvice, TheFastestOfThoseThatDoNearlyAsMuch) {
  const Separating of = chosen({0.99, 0.95, 0.60});
  EXPECT_EQ(of.plan, "fast");
  EXPECT_EQ(of.power_before, 0.5);
  EXPECT_EQ(of.power, 0.95);
  EXPECT_EQ(of.minutes, 5.0);
  ASSERT_EQ(of.others.size(), 1U);
  EXPECT_EQ(of.others.front().plan, "slow");
  // Of a rise of 0.49 the fast one has 0.38, less than four fifths.
  EXPECT_EQ(chosen({0.99, 0.88, 0.60}, 0.85).plan, "slow");
}

// A rise of two in a hundred is worth a measurement, a smaller one is not.
TEST(InferAdvice, ASmallRiseIsWorthNothing) {
  const auto plan = [](double after) {
    return choose({plans.data(), 1}, 0.9, {after}, 0.9, "nothing").plan;
  };
  EXPECT_EQ(plan(0.915), "");
  EXPECT_EQ(plan(0.93), "slow");
  EXPECT_EQ(choose({}, 0.9, {}, 0.9, "nothing").why_not, "nothing");
}

TEST(InferAdvice, NoneThatDoesNotMakeSureOrRaisesNothing) {
  for (const std::vector<double>& after :
       {std::vector{0.89, 0.7, 0.6}, {0.51, 0.5, 0.4}, {0.4, 0.3, 0.2}}) {
    const Separating of = chosen(after);
    EXPECT_EQ(of.plan, "");
    EXPECT_EQ(of.power_before, of.power);
    EXPECT_EQ(of.minutes, 0.0);
    EXPECT_TRUE(of.why_not.starts_with("nothing tells them apart")) << of.why_not;
  }
}

// Weights of binary fractions, so that sums are exact.
TEST(InferAdvice, ARankingHasTheWeightedMeans) {
  Ranking ranking(plans);
  EXPECT_FALSE(ranking.any());
  EXPECT_EQ(ranking.before(), 0.0);
  ranking.count(0.5, {0.75, 1.0, 0.5}, 0.9, 0.125);
  ranking.count(0.25, {1.0, 0.5, 0.25}, 0.9, 0.375);
  EXPECT_EQ(ranking.before(), (0.5 + 3.0 * 0.25) / 4.0);
  EXPECT_EQ(ranking.after(0), (0.75 + 3.0 * 1.0) / 4.0);
  EXPECT_EQ(ranking.after(1), (1.0 + 3.0 * 0.5) / 4.0);
  EXPECT_TRUE(ranking.any());
  // Gains where it makes sure: 3 × 0.75 of the slow one, 0.5 of the fast one, none of the weak; of
  // each an eighth.
  EXPECT_EQ(ranking.order(), (std::vector<std::size_t>{0, 1, 2}));
  ranking.count(0.0, {0.5, 1.0, 0.0}, 0.9, 1.75 / 8.0);  // now 2.25 of each: the fastest first
  EXPECT_EQ(ranking.order(), (std::vector<std::size_t>{1, 0, 2}));
}

}  // namespace
}  // namespace trueaxis::infer
