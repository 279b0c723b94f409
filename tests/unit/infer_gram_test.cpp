// SPDX-License-Identifier: Apache-2.0
// Least squares by a Gram matrix whose columns depend on each other.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "infer/gram.hpp"

namespace trueaxis::infer {
namespace {

/// Readings and so many columns of noise: nothing is at right angles by accident.
Eigen::MatrixXd noise_of(Eigen::Index readings, Eigen::Index width, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(readings, width, [&] { return normal(random); });
}

// A A⁻ A = A and A⁻ A A⁻ = A⁻ (Penrose 1955) for the normal matrix A of columns of which two are
// alike and one is zero. Entries of A are some 60 and of A⁻ 1/60: the rounding of a few hundred
// products of them is far below 1e-9 of each.
TEST(InferGram, TheInverseOfColumnsThatDependIsReflexive) {
  Eigen::MatrixXd table = noise_of(60, 6, 11);
  table.col(3) = table.col(1), table.col(5).setZero();
  const Eigen::MatrixXd gram = table.transpose() * table;
  const Solution found = solve(gram, {1, 2, 3, 4, 5});
  const Eigen::MatrixXd normal = gram.bottomRightCorner(5, 5), &inverse = found.inverse;
  EXPECT_EQ(found.rank, 3U);
  EXPECT_LT((normal * inverse * normal - normal).norm(), 1e-9 * normal.norm());
  EXPECT_LT((inverse * normal * inverse - inverse).norm(), 1e-9 * inverse.norm());
  const Eigen::MatrixXd independent = table(Eigen::all, {1, 2, 4});
  const Eigen::VectorXd left =
      table.col(0) - independent * independent.colPivHouseholderQr().solve(table.col(0));
  EXPECT_NEAR(found.rss, left.squaredNorm(), 1e-9 * left.squaredNorm());
  EXPECT_NEAR(found.coefficients(0), found.coefficients(2), 1e-9);  // shared equally
  EXPECT_EQ(found.coefficients(4), 0.0);
}

// Two columns that differ by 1e-6 of themselves leave 1e-12 of their square: rounding. Their
// difference, which the readings hold, is then not fitted, by neither of the two ways.
TEST(InferHeldOut, ADirectionThatIsRoundingIsNotFittedEitherWay) {
  Eigen::MatrixXd table = noise_of(200, 4, 12);
  table.col(0) += 3.0 * table.col(3);
  table.col(2) = table.col(1) + 1e-6 * table.col(3);
  const Eigen::MatrixXd total = table.transpose() * table;
  const Eigen::MatrixXd own = table.topRows(50), fold = own.transpose() * own;
  const double exact = held_out(total, fold, {1, 2});
  EXPECT_NEAR(exact, held_out(total, fold, {1}), 1e-6 * exact);
  EXPECT_NEAR(held_out_fast(total, fold, {1, 2}), exact, 1e-6 * exact);
}

}  // namespace
}  // namespace trueaxis::infer
