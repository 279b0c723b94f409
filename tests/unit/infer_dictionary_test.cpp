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

}  // namespace
}  // namespace trueaxis::infer
