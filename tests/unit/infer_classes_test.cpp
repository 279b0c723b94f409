// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "infer/classes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::infer {
namespace {

// Readings y of one wave and of another that nearly is the same: with an unknown noise the
// likelihood of a model that leaves the sum of squares S is proportional to S^(−f/2), and both have
// one parameter.
TEST(InferClasses, TheLogarithmOfTheLikelihoodRatioIsOfLeastSquaresWrittenOut) {
  constexpr Eigen::Index n = 100;
  Eigen::MatrixXd columns(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double c = two_pi * static_cast<double>(i) / n;
    const double wave = std::cos(c), other = std::cos(c - 0.1);
    columns.row(i) << 2.0 * wave + std::cos(7.0 * c) + 0.3 * std::sin(c), wave, other;
  }
  const auto left = [&](Eigen::Index column) {
    const Eigen::VectorXd y = columns.col(0), x = columns.col(column);
    return (y - x * (x.dot(y) / x.squaredNorm())).squaredNorm();
  };
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  const Projection beside = project(gram, {});
  const Score named = score(beside, {1}), other = score(beside, {2});
  const Eigen::VectorXd coefficient = Eigen::VectorXd::Constant(1, gram(1, 0) / gram(1, 1));
  constexpr double freedom = n - 1, variance = 1.0;
  const auto class_with = [&](std::size_t rank) {
    const Cause rival{"the other", {2}, other.gain, rank, 0.0};
    return distinguish(gram, {}, beside, {{1}, coefficient, 0.0}, {&rival, 1}, variance, freedom);
  };
  const Class found = class_with(other.rank);
  ASSERT_EQ(named.rank, other.rank);
  ASSERT_EQ(found.members.size(), 1U);
  const double expected = -0.5 * freedom * std::log(left(1) / left(2));
  ASSERT_GT(std::abs(expected), 0.1);
  // Gram matrix and columns differ by the rounding of n products, of a sum of squares of 100.
  EXPECT_NEAR(found.members.front().rival.log_likelihood_ratio, expected, 1e-10);
  // A parameter more costs 1 of it (Akaike 1974).
  EXPECT_NEAR(class_with(other.rank + 1).members.front().rival.log_likelihood_ratio, expected + 1.0,
              1e-10);
}

// Two waves at right angles, each with a square of 10: the rival cause explains nothing of the
// named prediction, so its distance is the size of that over σ. A member is near, or the data do
// not tell.
TEST(InferClasses, AMemberIsNearOrAsLikely) {
  Eigen::MatrixXd gram = 10.0 * Eigen::MatrixXd::Identity(3, 3);
  gram(0, 0) = 1000.0;
  gram(0, 1) = gram(1, 0) = 50.0;
  const Projection beside = project(gram, {});
  constexpr double freedom = 100.0;
  const Score named = score(beside, {1});
  const auto is_member = [&](double distance, double twice_log_ratio) {
    const double left = (1000.0 - named.gain) * std::exp(twice_log_ratio / freedom);
    const Cause rival{"the other", {2}, 1000.0 - left, named.rank, 0.0};
    const Eigen::VectorXd coefficient = Eigen::VectorXd::Constant(1, distance / std::sqrt(10.0));
    return !distinguish(gram, {}, beside, {{1}, coefficient, 0.0}, {&rival, 1}, 1.0, freedom)
                .members.empty();
  };
  EXPECT_TRUE(is_member(0.99 * told_apart, 1.01 * likelihood_tells));
  EXPECT_TRUE(is_member(1.01 * told_apart, 0.99 * likelihood_tells));
  EXPECT_FALSE(is_member(1.01 * told_apart, 1.01 * likelihood_tells));
}

// One that the data tell and that does most of what the named cause does (95 % of it: a tenth of
// its square is left) may be it where its columns bend; one that does 85 % or is at right angles
// may not.
TEST(InferClasses, OneThatIsToldAndMuchAlikeIsDroppedAsTold) {
  const auto dropped = [](double alike) {
    Eigen::MatrixXd gram = 10.0 * Eigen::MatrixXd::Identity(3, 3);
    gram(0, 0) = 1000.0, gram(0, 1) = gram(1, 0) = 50.0;
    gram(1, 2) = gram(2, 1) = 10.0 * alike;
    const Projection beside = project(gram, {});
    const Cause rival{"the other", {2}, 0.0, 1, 0.0};
    const Eigen::VectorXd coefficient = Eigen::VectorXd::Constant(1, 5.0);
    const Class found =
        distinguish(gram, {}, beside, {{1}, coefficient, 0.0}, {&rival, 1}, 1.0, 100.0);
    EXPECT_TRUE(found.members.empty());
    return found.dropped;
  };
  EXPECT_TRUE(dropped(0.0).empty());
  EXPECT_TRUE(dropped(0.85).empty());
  ASSERT_EQ(dropped(0.95).size(), 1U);
  EXPECT_TRUE(dropped(0.95).front().told);
  EXPECT_EQ(dropped(0.95).front().probability, 0.0);
}

// Rival causes that the readings show as well as the named one differ by their criteria, −2 ln of
// the likelihood, alone: of 1 : e^−0.5 : e^−2 : e^−10 all but the last are above 1e-3. Criteria of
// thousands have likelihoods beyond any number, and the same ratios.
TEST(InferClasses, ProbabilitiesAreThoseOfTheCriteria) {
  Eigen::MatrixXd gram = 10.0 * Eigen::MatrixXd::Identity(5, 5);
  gram.row(0).setConstant(50.0), gram.col(0).setConstant(50.0);
  gram(0, 0) = 2000.0;
  const Projection beside = project(gram, {});
  const double gain = score(beside, {1}).gain;
  const Eigen::VectorXd coefficient = Eigen::VectorXd::Constant(1, 0.1);
  for (const double base : {-5000.0, 0.0, 5000.0}) {
    const Cause causes[] = {{"e^-2", {2}, gain, 1, base + 4.0},
                            {"e^-0.5", {3}, gain, 1, base + 1.0},
                            {"e^-10", {4}, gain, 1, base + 20.0}};
    const Class found = distinguish(gram, {}, beside, {{1}, coefficient, base}, causes, 1.0, 100.0);
    const double all = 1.0 + std::exp(-0.5) + std::exp(-2.0) + std::exp(-10.0);
    EXPECT_NEAR(found.probability, 1.0 / all, 1e-9);
    ASSERT_EQ(found.members.size(), 2U);
    for (const std::size_t k : {0U, 1U}) {
      EXPECT_EQ(found.members[k].rival.effect, k == 0 ? "e^-0.5" : "e^-2");
      EXPECT_NEAR(found.members[k].rival.probability, std::exp(k == 0 ? -0.5 : -2.0) / all, 1e-9);
      EXPECT_NEAR(found.members[k].rival.distance, 0.1 * std::sqrt(10.0), 1e-9);
      EXPECT_FALSE(found.members[k].rival.structural) << "at right angles";
    }
    ASSERT_EQ(found.dropped.size(), 1U);
    EXPECT_NEAR(found.dropped.front().probability, std::exp(-10.0) / all, 1e-9);
    EXPECT_FALSE(found.dropped.front().told);
  }
}

// One whose columns are those of the named cause is told from it by no readings, however little
// they show of it. Of several causes of one effect the first counts.
TEST(InferClasses, TheSameColumnsAreTheSameStructure) {
  Eigen::MatrixXd gram = 10.0 * Eigen::MatrixXd::Identity(3, 3);
  gram(0, 0) = 1000.0, gram(0, 1) = gram(1, 0) = 0.5;
  gram(0, 2) = gram(2, 0) = 0.5, gram(1, 2) = gram(2, 1) = 10.0;
  const Projection beside = project(gram, {});
  const Cause causes[] = {{"the other", {2}, 0.025, 1, 0.0}, {"the other", {2}, 0.025, 1, 0.0}};
  const Class found = distinguish(gram, {}, beside, {{1}, Eigen::VectorXd::Constant(1, 0.05), 0.0},
                                  causes, 1.0, 100.0);
  ASSERT_EQ(found.members.size(), 1U);
  EXPECT_TRUE(found.members.front().rival.structural);
}

// Φ(1.645) = 0.95 of two that are 3.29 σ apart; of several the mean by how often each is the cause.
TEST(InferClasses, TheRightNameOfTwoIsThatOfHalfTheirDistance) {
  EXPECT_EQ(right_name(0.0), 0.5);
  EXPECT_NEAR(right_name(2.0 * 1.644854), 0.95, 1e-6);
  EXPECT_NEAR(right_name(told_apart), 0.95, 1e-5);
  EXPECT_EQ(right_name_of({}, {}), 1.0) << "no other cause";
  std::vector<Rival> rivals(2);
  rivals[0].probability = 0.3, rivals[1].probability = 0.1;
  EXPECT_NEAR(right_name_of(rivals, {0.0, told_apart}), 0.75 * 0.5 + 0.25 * 0.95, 1e-5);
}

}  // namespace
}  // namespace trueaxis::infer
