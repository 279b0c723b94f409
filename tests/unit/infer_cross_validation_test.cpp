// SPDX-License-Identifier: Apache-2.0
// Blocks that are predicted by the others, against refits by QR, and their block bootstrap.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "infer/cross_validation.hpp"

namespace trueaxis::infer {
namespace {

constexpr Eigen::Index blocks = 40, in_block = 25, columns = 4;  // column 0: the readings

/// Readings that columns 1 and 2 explain, column 3 does not, with noise of 1.
Eigen::MatrixXd drawn() {
  std::mt19937_64 random(20261128);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd table(blocks * in_block, columns);
  for (double& value : table.reshaped()) value = normal(random);
  table.col(0) += 3.0 * table.col(1) - 2.0 * table.col(2);
  return table;
}

/// Root mean square of what the first columns, fitted to the other blocks, leave of each block.
double root_mean_by_refit(const Eigen::MatrixXd& table, Eigen::Index fitted) {
  double sum = 0.0;
  for (Eigen::Index b = 0; b < blocks; ++b) {
    Eigen::MatrixXd others(table.rows() - in_block, columns);
    others << table.topRows(b * in_block), table.bottomRows(table.rows() - (b + 1) * in_block);
    const Eigen::VectorXd sizes =
        others.middleCols(1, fitted).colPivHouseholderQr().solve(others.col(0));
    const Eigen::MatrixXd own = table.middleRows(b * in_block, in_block);
    sum += (own.col(0) - own.middleCols(1, fitted) * sizes).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(table.rows()));
}

Explained validated(const Eigen::MatrixXd& table, double unit2) {
  std::vector<Fold> folds;
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const Eigen::MatrixXd own = table.middleRows(b * in_block, in_block);
    folds.push_back({own.transpose() * own, static_cast<double>(in_block), unit2});
  }
  Explained out;
  cross_validate(table.transpose() * table, folds, {1}, {1, 2, 3}, out);
  return out;
}

// Sums of squares of 1e4 that cancel to 1e3 keep 1e-12 of themselves.
TEST(InferCrossValidation, IsTheRefitWithoutEachBlockInItsUnit) {
  const Eigen::MatrixXd table = drawn();
  const Explained out = validated(table, 1e-6);
  const double before = root_mean_by_refit(table, 1), after = root_mean_by_refit(table, 3);
  EXPECT_NEAR(out.held_out_before_mm.value, 1e-3 * before, 1e-12 * before);
  EXPECT_NEAR(out.held_out_after_mm.value, 1e-3 * after, 1e-12 * after);
  EXPECT_NEAR(out.held_out_ratio.value, after / before, 1e-9);
}

// The variance of noise in a block of 25 has a standard deviation of sqrt(2/25): the root mean of
// 40 blocks has 1/sqrt(2 · 1000) = 0.022 of itself. The percentiles are 1.96 of it apart from the
// value, and those of 40 blocks are themselves known to 1/sqrt(2 · 40) = 0.11; three times that.
TEST(InferCrossValidation, IntervalsAreAsWideAsTheBlocksScatter) {
  const Explained out = validated(drawn(), 1.0);
  const double u =
      out.held_out_after_mm.value / std::sqrt(2.0 * static_cast<double>(blocks * in_block));
  const double width = out.held_out_after_mm.high - out.held_out_after_mm.low;
  EXPECT_NEAR(width, 2.0 * 1.96 * u, 0.35 * 2.0 * 1.96 * u);
  EXPECT_LT(out.held_out_after_mm.low, out.held_out_after_mm.value);
  EXPECT_GT(out.held_out_after_mm.high, out.held_out_after_mm.value);
}

// Of 20 blocks three hold a reading and the others nothing: a resampling of 20 misses all three
// with probability 0.85^20 = 3.9 %, and 2.5 % of the resamplings are below the interval.
TEST(InferCrossValidation, AnIntervalBeginsAt25InAThousand) {
  std::vector<Fold> folds(20, {Eigen::MatrixXd::Zero(1, 1), 1.0, 1.0});
  for (std::size_t b = 0; b < 3; ++b) folds[b].gram(0, 0) = 4.0;
  Explained out;
  cross_validate(Eigen::MatrixXd::Constant(1, 1, 12.0), folds, {}, {}, out);
  EXPECT_NEAR(out.held_out_before_mm.value, std::sqrt(12.0 / 20.0), 1e-12);
  EXPECT_EQ(out.held_out_before_mm.low, 0.0);
  EXPECT_EQ(out.held_out_ratio.value, 1.0);
  EXPECT_EQ(out.held_out_ratio.low, 1.0) << "of nothing";
  EXPECT_EQ(out.held_out_ratio.high, 1.0);
}

TEST(InferCrossValidation, BlocksThatAreAlikeHaveNoInterval) {
  Eigen::MatrixXd table = drawn();
  for (Eigen::Index b = 1; b < blocks; ++b)
    table.middleRows(b * in_block, in_block) = table.topRows(in_block);
  for (const Interval& i :
       {validated(table, 1.0).held_out_before_mm, validated(table, 1.0).held_out_ratio}) {
    EXPECT_GT(i.value, 0.0);
    EXPECT_NEAR(i.low, i.value, 1e-12 * i.value);
    EXPECT_NEAR(i.high, i.value, 1e-12 * i.value);
  }
}

}  // namespace
}  // namespace trueaxis::infer
