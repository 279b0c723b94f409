// SPDX-License-Identifier: Apache-2.0
// The search over hypotheses whose columns are known beforehand: of a made-up measurement, without
// a machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
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

// Nor in a pair. The search takes the first of two that are alike.
TEST(InferDictionary, TakesNeitherWhatIsBarredNextToAnotherNorTheSecondOfTwoAlike) {
  Measurement one(6, 10);
  one.list[7].columns = one.list[3].columns;
  one.plant(0), one.plant(3);
  EXPECT_EQ(found(one.dictionary()), (Dictionary::Set{0, 3}));
  one.list[0].barred = true;
  EXPECT_EQ(found(one.dictionary()), Dictionary::Set{3});
}

// By least squares of all columns: what a rival cause leaves of the named prediction, over σ of the
// residuals with all terms.
TEST(InferDictionary, TheDistanceIsWhatTheRivalLeavesOfThePrediction) {
  Measurement one(11, 3);
  one.residuals += 2.0 * one.list[0].columns.col(1) / one.list[0].columns.col(1).norm();
  const auto left = [](const Eigen::MatrixXd& of, const Eigen::MatrixXd& y) -> Eigen::MatrixXd {
    return y - of * of.colPivHouseholderQr().solve(y);
  };
  Eigen::MatrixXd all(rows, 5), rival(rows, 5);
  all << one.base, one.list[0].columns;
  rival << one.base, one.list[2].columns;
  const Eigen::VectorXd sizes = all.colPivHouseholderQr().solve(one.residuals).tail(2);
  const double sigma = std::sqrt(left(all, one.residuals).squaredNorm() / (rows - 5));
  const double expected = left(rival, one.list[0].columns * sizes).norm() / sigma;
  const Class of = class_of(one.dictionary(), {0}, 0);
  const auto found = std::ranges::find(of.members, "effect 2",
                                       [](const Class::Member& m) { return m.rival.effect; });
  ASSERT_NE(found, of.members.end());
  EXPECT_NEAR(found->rival.distance, expected, 1e-9);
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

// Next to the first column the second is 6 σ of 37 readings: of Student's t. Just above the level
// of its family it stays out, in a pair as well, though the criterion is better with it.
TEST(InferDictionary, ATermPassesBelowItsLevelAndNotJustAboveIt) {
  std::vector<Hypothesis> list(2);
  list[0].columns = 5.0 * Eigen::VectorXd::Unit(40, 1), list[0].largest = 20.0;
  list[1].columns = 5.0 * Eigen::VectorXd::Unit(40, 2), list[1].largest = 20.0;
  Dictionary dictionary(list, Eigen::VectorXd::Unit(40, 0));
  Eigen::VectorXd residuals = Eigen::VectorXd::Ones(40);
  residuals(1) = 60.0, residuals(2) = 6.0;
  dictionary.take(residuals);
  const boost::math::students_t t(37.0);
  const double p = 2.0 * cdf(complement(t, 6.0));
  const auto places = [&](double level) { return -std::log1p(-0.01) * share_of_effects / level; };
  EXPECT_EQ(search(dictionary, {0.01, places(1.1 * p)}).size(), 2U);
  EXPECT_EQ(search(dictionary, {0.01, places(p / 1.1)}), Dictionary::Set{0});
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
  EXPECT_EQ(Dictionary({}, one.base).tests(), 1.0);
}

// Columns of length 5 show a size of 0.21 as 1.05 σ, and one of 0.19 as 0.95, below the noise.
TEST(InferDictionary, ADirectionBelowOneSigmaAtItsLargestIsDropped) {
  for (const double largest : {0.21, 0.27, 0.19}) {
    Hypothesis one;
    one.columns = 5.0 * Eigen::MatrixXd::Identity(8, 1);
    one.largest = largest, one.tests = 30.0;
    const Dictionary dictionary({one}, Eigen::VectorXd::Unit(8, 7));
    EXPECT_EQ(dictionary.block(0).columns.size(), largest > 0.2 ? 1U : 0U);
    EXPECT_EQ(dictionary.tests(), largest > 0.2 ? 30.0 : 1.0);
  }
}

// 2 ln N of the choice among N places, and what a pattern costs (Eq. 78).
TEST(InferDictionary, TheChoiceAmongManyCostsTwiceItsLogarithm) {
  Measurement one(31, 3);
  one.plant(1);
  const auto criterion = [&](double tests, bool pattern) {
    one.list[1].tests = tests, one.list[1].pattern = pattern;
    const Dictionary dictionary = one.dictionary();
    return dictionary.weighed(1, dictionary.beside({})).criterion;
  };
  const double alone = criterion(1.0, false);
  EXPECT_NEAR(criterion(50.0, false) - alone, 2.0 * std::log(50.0), 1e-9);
  EXPECT_NEAR(criterion(50.0, true) - alone, 2.0 * std::log(50.0) + catalogue_first, 1e-9);
  EXPECT_EQ(criterion(0.5, false), alone) << "no choice pays";
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

// An effect with a phase that the rows do not show may be there at any size.
TEST(InferDictionary, WhatDoesNotShowInOnePhaseIsNotDetectable) {
  Measurement one(29, 3);
  one.list[1].columns.col(1) = 2.0 * one.list[1].columns.col(0);
  one.list[2].largest = 1e-3;  // of 12 σ: never one
  const Dictionary dictionary = one.dictionary();
  const SearchOptions options{0.01, dictionary.tests()};
  const Detection detection(dictionary, {}, 1.0, options);
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_EQ(detection.lambda(k), 0.0);
    EXPECT_TRUE(std::isinf(detection.detectable_size(k)));
    EXPECT_EQ(detection.power(k, 1e3), options.effects().single_level(0.01));
  }
  EXPECT_LT(detection.detectable_size(0), 10.0);
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
