// SPDX-License-Identifier: Apache-2.0
// Least squares by a Gram matrix whose columns depend on each other.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "infer/fitted.hpp"
#include "infer/gram.hpp"
#include "infer/significance.hpp"

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

/// A base of one column and two terms, of two columns and of one, none at right angles.
class InferFitted : public ::testing::Test {
 protected:
  static constexpr Eigen::Index readings = 40;
  Eigen::MatrixXd table = [] {
    Eigen::MatrixXd out = noise_of(readings, 5, 13);
    out.col(0) += out.col(1) + 0.4 * out.col(2) - 0.3 * out.col(3) + 0.5 * out.col(4);
    out.col(4) += 0.7 * out.col(2);
    return out;
  }();
  Eigen::MatrixXd gram = table.transpose() * table;
  Fitted model{gram, {1}, {{2, 3}, {4}}, static_cast<std::size_t>(readings)};

  /// Columns after others, by their decomposition.
  Eigen::MatrixXd after(const std::vector<Eigen::Index>& others,
                        const std::vector<Eigen::Index>& columns) const {
    const Eigen::MatrixXd of = table(Eigen::all, others), own = table(Eigen::all, columns);
    return own - of * of.colPivHouseholderQr().solve(own);
  }
  double left(const std::vector<Eigen::Index>& columns) const {
    return after(columns, {0}).squaredNorm();
  }
  /// ln det(G + Λ) of columns after others.
  double width(const std::vector<Eigen::Index>& others, const std::vector<Eigen::Index>& columns,
               const Eigen::VectorXd& adds) const {
    const Eigen::MatrixXd own = after(others, columns);
    return std::log((Eigen::MatrixXd(adds.asDiagonal()) + own.transpose() * own).determinant());
  }
};

// Eqs. 81 and 82a written out.
TEST_F(InferFitted, TheCriterionIsThatOfTheResidualsAndOfEachTerm) {
  const Eigen::Vector2d first(0.5, 0.7);
  const Eigen::VectorXd second = Eigen::VectorXd::Constant(1, 1.1);
  const WeighTerm weigh = [&](std::size_t term, const Projection&) {
    Weighed out;
    out.criterion = term == 0 ? 7.5 : -3.25;
    out.precision = term == 0 ? Eigen::VectorXd(first) : second;
    return out;
  };
  const double all = left({1, 2, 3, 4});
  const double expected = 39.0 * std::log(all / gram(0, 0)) + 7.5 -
                          38.0 * std::log(all / left({1, 4})) - 3.25 -
                          37.0 * std::log(all / left({1, 2, 3}));
  EXPECT_NEAR(model.criterion(weigh), expected, 1e-9);
  const double widths = width({1}, {2, 3, 4}, Eigen::Vector3d(0.5, 0.7, 1.1)) -
                        width({1, 4}, {2, 3}, first) - width({1, 2, 3}, {4}, second);
  ASSERT_GT(std::abs(widths), 0.1);
  EXPECT_NEAR(model.criterion(weigh, true), expected + widths, 1e-9);
}

TEST_F(InferFitted, ATermIsTestedAndSizedAfterAllOthers) {
  const double all = left({1, 2, 3, 4});
  EXPECT_NEAR(model.log_p(0), log_p_value(left({1, 4}) - all, 2.0, left({1, 4}), 38.0), 1e-9);
  EXPECT_NEAR(model.log_p(1), log_p_value(left({1, 2, 3}) - all, 1.0, left({1, 2, 3}), 37.0), 1e-9);
  const Eigen::VectorXd sizes = table.rightCols(4).colPivHouseholderQr().solve(table.col(0));
  EXPECT_LT((model.of(0) - sizes.segment<2>(1)).norm(), 1e-9);
  EXPECT_NEAR(model.of(1)(0), sizes(3), 1e-9);
}

// Two columns that are nearly one hide each other: without the weaker the other passes. A third
// passes next to both, and a fourth by no means.
TEST(InferRemaining, OfTwoThatHideEachOtherOneStays) {
  Eigen::MatrixXd hidden = noise_of(60, 5, 14);
  hidden.col(2) = hidden.col(1) + 0.02 * hidden.col(2);
  hidden.col(0) += 0.7 * hidden.col(1) + 0.7 * hidden.col(2) + 1.5 * hidden.col(4);
  const Eigen::MatrixXd gram = hidden.transpose() * hidden;
  const Fitted model{gram, {}, {{1}, {2}, {3}, {4}}, 60};
  const double level = std::log(0.01);
  ASSERT_GT(model.log_p(0), level);
  ASSERT_GT(model.log_p(1), level);
  const std::vector<std::size_t> found = remaining(model, std::vector<double>(4, level));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(found[0], 2U);
  EXPECT_EQ(found[1], 3U);
  // Each has its own level: one that is never reached.
  EXPECT_EQ(remaining(model, {level, level, level, -1e6}).size(), 1U);
  EXPECT_EQ(remaining(model, std::vector<double>(4, 1.0)).size(), 4U);
}

}  // namespace
}  // namespace trueaxis::infer
