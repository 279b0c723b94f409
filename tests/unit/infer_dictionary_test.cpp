// SPDX-License-Identifier: Apache-2.0
// The search over hypotheses whose columns are known beforehand: of a made-up measurement, without
// a machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "infer/dictionary_search.hpp"

namespace trueaxis::infer {
namespace {

constexpr Eigen::Index rows = 150;
constexpr double found_surely = 14.0;  // σ: of F tests at 1 % over 50 the power is 1 − 1e-12

struct Measurement {
  std::mt19937_64 random;
  std::vector<Hypothesis> list;
  Eigen::MatrixXd base;
  Eigen::VectorXd residuals;

  Measurement(std::uint64_t seed, int hypotheses)
      : random(seed), base(normal(3)), residuals(normal(1)) {
    for (int k = 0; k < hypotheses; ++k) {
      Hypothesis one;
      one.name = "effect " + std::to_string(k);
      one.columns = normal(2);
      list.push_back(std::move(one));
    }
  }
  Eigen::MatrixXd normal(Eigen::Index columns) {
    std::normal_distribution<double> draw;
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return draw(random); });
  }
  void plant(std::size_t k) {
    residuals += found_surely * list[k].columns.col(1) / list[k].columns.col(1).norm();
  }
  Dictionary dictionary() const {
    Dictionary out(list, base);
    out.take(residuals);
    return out;
  }
};

Dictionary::Set found(const Dictionary& dictionary) {
  Dictionary::Set set = search(dictionary, {0.01, dictionary.tests()});
  std::ranges::sort(set);
  return set;
}

// A false alarm in one of a hundred measurements: three of forty have a probability of 1 %.
TEST(InferDictionary, FindsWhatIsThereAndNothingElse) {
  int more = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Measurement one(seed, 30);
    one.plant(4), one.plant(17);
    const Dictionary::Set set = found(one.dictionary());
    EXPECT_TRUE(std::ranges::includes(set, Dictionary::Set{4, 17}));
    more += set.size() > 2;
  }
  EXPECT_LE(more, 2);
}

TEST(InferDictionary, TakesNothingThatIsBarred) {
  Measurement one(5, 10);
  one.plant(3);
  ASSERT_EQ(found(one.dictionary()), Dictionary::Set{3});
  one.list[3].barred = true;
  EXPECT_EQ(found(one.dictionary()), Dictionary::Set{});
}

// Columns that span the same are told from each other by no data; others at right angles are.
TEST(InferDictionary, AClassHoldsWhatSpansTheSame) {
  Measurement one(9, 10);
  one.list[7].columns.col(0) = one.list[2].columns.col(0) + one.list[2].columns.col(1);
  one.list[7].columns.col(1) = -3.0 * one.list[2].columns.col(1);
  one.plant(2);
  const Class of = class_of(one.dictionary(), {2}, 0);
  ASSERT_EQ(of.members.size(), 1U);
  EXPECT_EQ(of.members.front().rival.effect, "effect 7");
  EXPECT_TRUE(of.members.front().rival.structural);
  EXPECT_LT(of.members.front().rival.distance, 1e-4);  // √ε of 14 σ
}

// A third effect is nearly the sum of two: alone it explains most, and next to it neither of the
// two explains its residual (0.15 of 60 σ). Both together have none. The two are among the best
// hundred of more than a hundred.
TEST(InferDictionary, OfTwoEffectsAThirdMayLookMostLikeBoth) {
  Measurement one(21, 140);
  one.list[120].columns =
      one.list[40].columns + one.list[90].columns + 0.15 * one.list[120].columns;
  const Eigen::VectorXd both = one.list[40].columns.col(1) + one.list[90].columns.col(1);
  one.residuals += 85.0 * both / both.norm();
  const Dictionary dictionary = one.dictionary();
  const Projection alone = dictionary.beside({});
  ASSERT_LT(dictionary.weighed(120, alone).criterion, dictionary.weighed(40, alone).criterion);
  ASSERT_LT(dictionary.weighed(120, alone).criterion, dictionary.weighed(90, alone).criterion);
  EXPECT_EQ(found(dictionary), (Dictionary::Set{40, 90}));
}

// By a decomposition of all columns: squares of the residual over the rows less all columns.
TEST(InferDictionary, TheVarianceIsOverTheFreedomThatIsLeft) {
  Measurement one(23, 5);
  one.plant(2);
  Eigen::MatrixXd all(rows, 5);
  all << one.base, one.list[2].columns;
  const Eigen::VectorXd left = one.residuals - all * all.colPivHouseholderQr().solve(one.residuals);
  EXPECT_NEAR(one.dictionary().variance({2}), left.squaredNorm() / (rows - 5), 1e-9);
}

TEST(InferDictionary, TestsAreThoseOfEffectsThatShowAtAll) {
  Measurement one(25, 4);
  for (std::size_t k = 0; k < 4; ++k) one.list[k].tests = 2.0 + static_cast<double>(k);
  one.list[1].pattern = true;
  one.list[2].largest = 1e-3;  // of 12 σ: never one
  EXPECT_EQ(one.dictionary().tests(), 2.0 + 5.0);
}

// Columns at right angles count one each. Of three whose correlations are all r the eigenvalues are
// 1 + 2 r and 1 − r twice: 0.6 makes of them 1 + 0.2 + 2 × 0.4.
TEST(InferDictionary, IndependentTestsAreThoseOfTheEigenvalues) {
  const auto independent = [](double r) {
    std::vector<Hypothesis> list(3);
    Eigen::MatrixXd correlations = Eigen::MatrixXd::Constant(3, 3, r);
    correlations.diagonal().setOnes();
    const Eigen::MatrixXd factor = correlations.llt().matrixU();
    for (Eigen::Index k = 0; k < 3; ++k) {
      Eigen::MatrixXd column = Eigen::MatrixXd::Zero(8, 1);
      column.topRows(3) = 5.0 * factor.col(k);
      list[static_cast<std::size_t>(k)].columns = column;
    }
    return Dictionary(list, Eigen::VectorXd::Unit(8, 7)).independent_tests();
  };
  EXPECT_NEAR(independent(0.0), 3.0, 1e-12);
  EXPECT_NEAR(independent(0.6), 2.0, 1e-12);
  EXPECT_EQ(Dictionary({}, Eigen::VectorXd::Unit(8, 7)).independent_tests(), 0.0);
}

// In the phase that shows it least λ of a size is its square times the least eigenvalue of the
// columns after the base, over the variance; in whatever unit the size is.
TEST(InferDictionary, ADetectableSizeIsFoundOnceInTwo) {
  constexpr double variance = 2.0;
  for (const double unit : {1e-3, 1.0, 1e3}) {
    Measurement one(27, 4);
    one.list[1].columns *= unit, one.list[1].largest = 10.0 / unit;
    const Dictionary dictionary = one.dictionary();
    const SearchOptions options{0.01, dictionary.tests()};
    const Detection detection(dictionary, {}, variance, options);
    const Eigen::MatrixXd after =
        one.list[1].columns - one.base * one.base.colPivHouseholderQr().solve(one.list[1].columns);
    const Eigen::Matrix2d gram = after.transpose() * after;
    const double least = gram.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
    EXPECT_NEAR(detection.lambda(1), least / variance, 1e-9 * least);
    const double size = detection.detectable_size(1);
    EXPECT_NEAR(detection.power(1, size), 0.5, 1e-6);
    EXPECT_GT(detection.power(1, 1.1 * size), 0.55);
    EXPECT_NEAR(detection.power(1, 0.0), options.effects().single_level(0.01), 1e-9);
  }
}

}  // namespace
}  // namespace trueaxis::infer
