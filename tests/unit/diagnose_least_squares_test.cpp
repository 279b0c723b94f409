// SPDX-License-Identifier: Apache-2.0
// solve, project and score on Gram matrices against QR on the matrices themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "infer/significance.hpp"
#include "support/dense.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Readings first, then columns of very different size, the last but one nearly the sum of others
/// and the last exactly twice the first of them.
struct Bench {
  MatrixXd all;
  MatrixXd gram;

  explicit Bench(double nearly) {
    constexpr Index n = 400;
    all.resize(n, 8);
    const std::vector<double> random = testing::white_noise(8 * n, 1.0, 21);
    all = Eigen::Map<const MatrixXd>(random.data(), n, 8);
    all.col(2) *= 1e4;
    all.col(3) *= 1e-3;
    all.col(0) += 2.0 * all.col(1) - 3e-4 * all.col(2) + 1.5e3 * all.col(3);
    all.col(6) = all.col(1) + all.col(4) + nearly * all.col(6);
    all.col(7) = 2.0 * all.col(1);
    gram = all.transpose() * all;
  }
  MatrixXd pick(const Columns& columns) const {
    MatrixXd out(all.rows(), static_cast<Index>(columns.size()));
    for (std::size_t j = 0; j < columns.size(); ++j)
      out.col(static_cast<Index>(j)) = all.col(static_cast<Index>(columns[j]));
    return out;
  }
  double rss(const Columns& columns) const {
    return testing::explicit_rss(pick(columns), all.col(0));
  }
};

// The Gram matrix squares the condition: a column that leaves 1e-3 of itself costs
// 1e-16/1e-6, and the readings' square is twenty times that of their residuals.
TEST(SolveGram, IsLeastSquares) {
  const Bench b(1e-3);
  const Columns columns{1, 2, 3, 4, 5, 6};
  const Solution s = solve(b.gram, columns);
  const MatrixXd x = b.pick(columns);
  const VectorXd expected = dense::least_squares(x, VectorXd(b.all.col(0)));
  EXPECT_EQ(s.rank, 6u);
  EXPECT_NEAR(s.rss, b.rss(columns), 1e-8 * b.rss(columns));
  for (Index j = 0; j < 6; ++j)
    EXPECT_NEAR(s.coefficients(j), expected(j),
                1e-7 * std::abs(expected(j)) + 1e-7 / x.col(j).norm())
        << j;
  const MatrixXd inverse = dense::inverse(x.transpose() * x);
  for (Index j = 0; j < 6; ++j) EXPECT_NEAR(s.inverse(j, j) / inverse(j, j), 1.0, 1e-6) << j;
}

TEST(SolveGram, LeavesOutWhatIsUndetermined) {
  const Bench b(0.1);
  const Columns columns{1, 2, 3, 7};
  const Solution s = solve(b.gram, columns);
  EXPECT_EQ(s.rank, 3u);
  EXPECT_NEAR(s.rss, b.rss({1, 2, 3}), 1e-9 * s.rss);
  const VectorXd expected = dense::least_squares(b.pick({1, 2, 3}), VectorXd(b.all.col(0)));
  EXPECT_NEAR(s.coefficients(0) + 2.0 * s.coefficients(3), expected(0), 1e-9);
  EXPECT_EQ(solve(b.gram, {}).rss, b.gram(0, 0));
}

TEST(ProjectGram, IsTheGramOfTheResiduals) {
  const Bench b(0.1);
  for (const Columns& taken : {Columns{1, 2, 5}, Columns{1, 3, 7}}) {
    const MatrixXd x = b.pick(taken);
    const MatrixXd residual = b.all - x * dense::least_squares(x, b.all);
    const Projection p = project(b.gram, taken);
    EXPECT_EQ(p.rank, taken.back() == 7 ? 2u : 3u);
    EXPECT_NEAR(p.rss, residual.col(0).squaredNorm(), 1e-9 * p.rss);
    const MatrixXd expected = residual.transpose() * residual;
    for (Index i = 0; i < 8; ++i) {
      EXPECT_EQ(p.norm2(i), b.gram(i, i));
      for (Index j = 0; j < 8; ++j)
        EXPECT_NEAR(p.gram(i, j), expected(i, j), 1e-11 * std::sqrt(b.gram(i, i) * b.gram(j, j)))
            << i << " " << j;
    }
  }
}

TEST(ScoreOfColumns, IsTheDecreaseOfTheSumOfSquares) {
  const Bench b(0.1);
  const Projection p = project(b.gram, {1, 2});
  const double before = b.rss({1, 2});
  for (const Columns& more : {Columns{3}, Columns{4}, Columns{3, 5}, Columns{4, 5, 6}}) {
    Columns all{1, 2};
    all.insert(all.end(), more.begin(), more.end());
    const Score s = score(p, more);
    EXPECT_EQ(s.rank, more.size());
    EXPECT_NEAR(s.gain, before - b.rss(all), 1e-9 * before);
  }
  // What the base has absorbed, and what repeats itself, is not counted twice.
  EXPECT_EQ(score(p, {7}).rank, 0u);
  EXPECT_EQ(score(p, {7}).gain, 0.0);
  EXPECT_EQ(score(p, {4, 6}).rank, 2u);
  const Score twice = score(project(b.gram, {2, 3}), {1, 7});
  EXPECT_EQ(twice.rank, 1u);
  EXPECT_NEAR(twice.gain, b.rss({2, 3}) - b.rss({1, 2, 3}), 1e-9 * before);
}

// Eq. 60: an effect regressed on the base fit's residuals shrinks by exactly ρ²; fitted jointly
// it does not. A bent part, s² from one end on after the line in s, keeps 1/36 = 2.8 %: on [0, 1]
// the variance of s² about its line is 1/180, its mean square 1/5. A helix of 60 turns is that
// integral to one part in its turns.
TEST(ScoreOfColumns, NaiveRegressionShrinksByRhoSquared) {
  const testing::HelixPlan plan;
  const LinearisationPoint point = testing::bench_point(plan, 0.0);
  const MatrixXd base = testing::explicit_columns(point, {});
  VectorXd bow(base.rows());
  for (std::size_t i = 0; i < point.size(); ++i)
    bow(static_cast<Index>(i)) = std::cos(point.c[i]) * std::pow(point.z[i] / plan.length_mm, 2);
  constexpr double amplitude = 0.02;
  MatrixXd all(base.rows(), base.cols() + 2);
  all << amplitude * bow + base * VectorXd::Constant(base.cols(), 0.01), base, bow;
  const MatrixXd gram = all.transpose() * all;
  const Columns taken{1, 2, 3, 4, 5};
  const Projection p = project(gram, taken);
  const VectorXd left = dense::residuals(base, bow);
  const double rho2 = left.squaredNorm() / bow.squaredNorm();
  EXPECT_NEAR(rho2, 1.0 / 36.0, 1.0 / 36.0 / 60.0);
  EXPECT_NEAR(p.gram(6, 0) / p.norm2(6), amplitude * rho2, 1e-9 * amplitude);
  EXPECT_NEAR(solve(gram, {1, 2, 3, 4, 5, 6}).coefficients(5), amplitude, 1e-9 * amplitude);
}

// To the floor of a sum of squares: (5e-4)² of the readings' mean square a row.
TEST(HeldOut, IsTheRefitWithoutTheBlock) {
  const LinearisationPoint point = testing::bench_point({.readings = 900}, 0.1);
  const ObservationMask mask = make_observation_mask(point);
  const std::vector<double> y = testing::white_noise(point.size(), 0.01, 5);
  constexpr bool blocks = true;
  NormalEquations equations(point, mask, y, {}, 1, blocks);
  const std::vector<Hypothesis> terms{testing::roundness(2)};
  equations.append(terms);
  Columns columns = equations.base();
  columns.insert(columns.end(), {7, 8});
  const MatrixXd x = testing::explicit_columns(point, terms);
  const VectorXd all = testing::as_vector(y);
  ASSERT_GE(mask.folds(), 25u);
  ASSERT_EQ(equations.folds().size(), mask.folds());
  for (std::size_t f = 0; f < mask.folds(); ++f) {
    const auto begin = static_cast<Index>(mask.fold_begin[f]);
    const auto end = static_cast<Index>(mask.fold_begin[f + 1]);
    MatrixXd rest(x.rows() - (end - begin), x.cols());
    VectorXd rest_y(rest.rows());
    rest << x.topRows(begin), x.bottomRows(x.rows() - end);
    rest_y << all.head(begin), all.tail(all.size() - end);
    const VectorXd fitted = dense::least_squares(rest, rest_y);
    const double expected =
        (all.segment(begin, end - begin) - x.middleRows(begin, end - begin) * fitted).squaredNorm();
    EXPECT_NEAR(held_out(equations.total(), equations.folds()[f], columns), expected,
                1e-6 * expected);
  }
}

// Of columns that are independent the ways differ by rounding: n ε times their condition, below
// 1e4, of the sum. Of columns that depend there is one way.
TEST(DiagnoseHeldOut, FasterToRounding) {
  const LinearisationPoint point = testing::bench_point({.readings = 900}, 0.1);
  const ObservationMask mask = make_observation_mask(point);
  const std::vector<double> y = testing::white_noise(point.size(), 0.01, 5);
  constexpr bool blocks = true;
  NormalEquations equations(point, mask, y, {}, 1, blocks);
  equations.append(std::vector<Hypothesis>{testing::roundness(2)});
  Columns columns = equations.base();
  columns.insert(columns.end(), {7, 8});
  for (const Eigen::MatrixXd& fold : equations.folds()) {
    const double expected = held_out(equations.total(), fold, columns);
    EXPECT_NEAR(held_out_fast(equations.total(), fold, columns), expected, 1e-9 * expected);
  }
  columns.push_back(7);
  for (const Eigen::MatrixXd& fold : equations.folds())
    EXPECT_EQ(held_out_fast(equations.total(), fold, columns),
              held_out(equations.total(), fold, columns));
}

}  // namespace
}  // namespace trueaxis
