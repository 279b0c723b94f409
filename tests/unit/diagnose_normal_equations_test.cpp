// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/regression/normal_equations.hpp"
#include "support/dense.hpp"
#include "support/diagnose_bench.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;
using Eigen::Index;
using Eigen::MatrixXd;

std::vector<Hypothesis> some_hypotheses() {
  Hypothesis cell;
  cell.pattern = {.order = 5.0, .degree = 2};
  return {testing::roundness(3), of_effect("probe.gain", {.reference_x_mm = 40.0}), cell,
          of_effect("spindle.asynchronous", {.order = 0.42})};
}

/// L⁻¹ of the covariance L Lᵀ of the first readings of an autoregression with innovations of
/// variance 1, by its impulse response: γ_k = Σ ψ_i ψ_{i+k}.
MatrixXd whitening_of_first(const std::vector<double>& phi) {
  const auto n = static_cast<Index>(phi.size());
  std::vector<double> psi{1.0};
  for (std::size_t i = 1; i < 4000; ++i) {
    psi.push_back(0.0);
    for (std::size_t j = 1; j <= std::min(i, phi.size()); ++j) psi[i] += phi[j - 1] * psi[i - j];
  }
  MatrixXd covariance = MatrixXd::Zero(n, n);
  for (Index r = 0; r < n; ++r)
    for (Index c = 0; c < n; ++c) {
      const auto lag = static_cast<std::size_t>(std::abs(r - c));
      for (std::size_t i = 0; i + lag < psi.size(); ++i) covariance(r, c) += psi[i] * psi[i + lag];
    }
  return dense::inverse(dense::cholesky(covariance));
}

/// Out in front and back at the rear, with excluded readings and a gap in the sampling.
struct Bench {
  ProbeStream stream;
  LinearisationPoint point;
  ObservationMask mask;
  std::vector<double> deviation;

  explicit Bench(std::size_t readings) {
    stream = testing::arguments({.readings = readings, .passes = 2});
    stream.setup = stream.pass;
    for (std::size_t i = readings / 2; i < stream.size(); ++i) stream.time_s[i] += 7.0;
    std::vector<Clamping> clampings(2, testing::bench_clamping(0.1));
    clampings[1].number = 2, clampings[1].root = Root::rear;
    point = linearise_at(ProbeStream(stream), clampings, testing::bench_base(0.1), false);
    mask = make_observation_mask(point);
    for (const std::size_t i : {std::size_t{0}, readings / 3, readings / 3 + 2, readings + 1})
      mask.mask(i);
    mask.find_runs(point);
    deviation = testing::white_noise(stream.size(), 0.01, 8);
  }

  /// Unbroken used readings before i: one pass, one clock.
  std::size_t before(std::size_t i) const {
    const std::size_t pass = stream.size() / 2, gap = pass / 2;
    std::size_t count = 0;
    while (i > count && i - count != pass && i - count != gap && mask.used[i - count - 1]) ++count;
    return count;
  }

  /// [deviation | base | list], whitened, masked rows gone; `from`, `to` choose readings. The first
  /// of a run by the inverse of a Cholesky factor of what the noise's autocovariance is there.
  MatrixXd dense(const std::vector<Hypothesis>& list, const std::vector<double>& phi,
                 std::size_t from, std::size_t to) const {
    const MatrixXd columns = testing::explicit_columns(point, list);
    MatrixXd raw(columns.rows(), columns.cols() + 1);
    raw << testing::as_vector(deviation), columns;
    MatrixXd out(static_cast<Index>(to - from), raw.cols());
    const MatrixXd start = whitening_of_first(phi);
    Index kept = 0;
    for (std::size_t i = from; i < to; ++i) {
      if (!mask.used[i]) continue;
      const auto now = static_cast<Index>(i), run = static_cast<Index>(before(i));
      if (run < start.rows()) {
        out.row(kept++) = start.row(run).head(run + 1) * raw.middleRows(now - run, run + 1);
        continue;
      }
      out.row(kept) = raw.row(now);
      for (std::size_t j = 0; j < phi.size(); ++j)
        out.row(kept) -= phi[j] * raw.row(now - static_cast<Index>(j) - 1);
      ++kept;
    }
    return out.topRows(kept);
  }
};

// Both sums have rounding of N units in the last place of the columns' sizes. The readings' own
// square has a floor in addition, of at most 5e-4 of their root mean square.
void expect_same_gram(const MatrixXd& gram, const MatrixXd& dense, const char* what) {
  const MatrixXd expected = dense.transpose() * dense;
  ASSERT_EQ(gram.rows(), expected.rows()) << what;
  for (Index i = 0; i < gram.rows(); ++i) {
    for (Index j = 0; j < gram.cols(); ++j) {
      const double rounding = i == 0 && j == 0 ? 1e-6 : 1e-12;
      EXPECT_NEAR(gram(i, j), expected(i, j),
                  rounding * std::sqrt(expected(i, i) * expected(j, j)) + 1e-300)
          << what << " " << i << " " << j;
    }
  }
}

enum : bool { sum_alone = false, with_blocks = true };

class NormalEquationsOf : public ::testing::TestWithParam<std::vector<double>> {};

TEST_P(NormalEquationsOf, IsTheGramOfTheExplicitMatrix) {
  const Bench b(1301);
  NormalEquations equations(b.point, b.mask, b.deviation, GetParam(), 1, with_blocks);
  const std::vector<Hypothesis> list = some_hypotheses();
  const auto places = equations.append(list);
  ASSERT_EQ(places.size(), list.size());
  EXPECT_EQ(places[0], (Columns{7, 8}));
  EXPECT_EQ(places[1], (Columns{9}));
  EXPECT_EQ(places[3], (Columns{12, 13}));
  const MatrixXd all = b.dense(list, GetParam(), 0, b.stream.size());
  EXPECT_EQ(equations.count(), static_cast<std::size_t>(all.rows()));
  expect_same_gram(equations.total(), all, "total");
  ASSERT_GE(equations.folds().size(), 25u);  // about thirty blocks
  for (std::size_t f = 0; f < equations.folds().size(); f += 5)
    expect_same_gram(equations.folds()[f],
                     b.dense(list, GetParam(), b.mask.fold_begin[f], b.mask.fold_begin[f + 1]),
                     "a block");
  NormalEquations alone(b.point, b.mask, b.deviation, GetParam(), 1, sum_alone);
  alone.append(list);
  expect_same_gram(alone.total(), all, "the sum alone");
}

// Whether columns are kept or made anew, the products are of the same numbers in the same order.
TEST_P(NormalEquationsOf, KeepsColumnsToTheLastBit) {
  const Bench b(1301);
  const std::vector<Hypothesis> list = some_hypotheses();
  const std::span<const Hypothesis> all(list);
  for (const bool blocks : {sum_alone, with_blocks}) {
    NormalEquations made(b.point, b.mask, b.deviation, GetParam(), 1, blocks);
    made.append(all.first(2));
    NormalEquations kept = made;
    kept.keep_columns();
    const NormalEquations copy = kept;
    const auto columns = static_cast<std::size_t>(made.total().rows());
    for (int time = 0; time < 2; ++time) {
      EXPECT_EQ(kept.append(all.subspan(2), 1), made.append(all.subspan(2), 1));
      EXPECT_EQ(kept.total(), made.total());
      kept.shrink(columns), made.shrink(columns);
    }
    EXPECT_EQ(copy.total(), made.total());
  }
}

TEST_P(NormalEquationsOf, AppendsAndShrinks) {
  const Bench b(700);
  const std::vector<Hypothesis> list = some_hypotheses();
  const MatrixXd all = b.dense(list, GetParam(), 0, b.stream.size());
  NormalEquations equations(b.point, b.mask, b.deviation, GetParam(), 1, with_blocks);
  const MatrixXd bare = equations.total();
  equations.append(std::span(list).first(2));
  const MatrixXd two = equations.total();
  equations.append(std::span(list).last(2));
  expect_same_gram(equations.total(), all, "in two steps");
  equations.shrink(static_cast<std::size_t>(two.rows()));
  EXPECT_EQ(equations.total(), two);
  equations.append(std::span(list).last(2));
  expect_same_gram(equations.total(), all, "again");
  equations.shrink(static_cast<std::size_t>(bare.rows()));
  EXPECT_EQ(equations.total(), bare);
  for (const MatrixXd& fold : equations.folds()) EXPECT_EQ(fold.rows(), bare.rows());
}

// Those after the first `together` are judged one by one: they have the products with those and
// with what was there, and their own; cells of one order in a row count as one. No other is made.
TEST_P(NormalEquationsOf, LeavesOutWhatIsNotAsked) {
  const Bench b(700);
  const std::vector<Hypothesis> some = some_hypotheses();
  Hypothesis constant;  // and after it the cell of order 5 and degree 2
  constant.pattern = {.order = 5.0};
  const std::vector<Hypothesis> list{some[0], some[1], constant, some[2], some[3]};
  constexpr std::size_t together = 1;
  const MatrixXd dense = b.dense(list, GetParam(), 0, b.stream.size());
  MatrixXd all = dense.transpose() * dense;
  NormalEquations equations(b.point, b.mask, b.deviation, GetParam(), 1, with_blocks);
  const std::vector<Columns> places = equations.append(list, together);
  MatrixXd sum = MatrixXd::Zero(all.rows(), all.cols());
  for (const MatrixXd& fold : equations.folds()) sum += fold;
  for (std::size_t a = together; a < list.size(); ++a) {
    for (std::size_t other = together; other < list.size(); ++other) {
      const bool cells = (a == 2 || a == 3) && (other == 2 || other == 3);
      if (a == other || cells) continue;
      for (const std::size_t i : places[a])
        for (const std::size_t j : places[other])
          all(static_cast<Index>(i), static_cast<Index>(j)) = 0.0;
    }
  }
  for (Index i = 1; i < all.rows(); ++i) {
    for (Index j = 0; j < all.cols(); ++j) {
      const double rounding = 1e-12 * std::sqrt(all(i, i) * all(j, j)) + 1e-300;
      EXPECT_NEAR(equations.total()(i, j), all(i, j), rounding) << i << " " << j;
      EXPECT_NEAR(sum(i, j), all(i, j), rounding) << i << " " << j;
    }
  }
}

TEST_P(NormalEquationsOf, DoesNotDependOnTheThreads) {
  const Bench b(24000);  // two passes: above the size from which the sum alone is shared out
  const std::vector<Hypothesis> list = some_hypotheses();
  for (const bool blocks : {with_blocks, sum_alone}) {
    MatrixXd first;
    for (const int threads : {1, 2, 5}) {
      NormalEquations equations(b.point, b.mask, b.deviation, GetParam(), threads, blocks);
      equations.append(list);
      if (threads == 1) first = equations.total();
      if (blocks) {
        EXPECT_GE(equations.folds().size(), 25u);
      }
      EXPECT_EQ(equations.total(), first) << threads;  // every bit
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, NormalEquationsOf,
                         ::testing::Values(std::vector<double>{}, std::vector<double>{0.6},
                                           std::vector<double>{0.5, 0.3}));

}  // namespace
}  // namespace trueaxis
