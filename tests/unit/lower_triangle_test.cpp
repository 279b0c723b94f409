// SPDX-License-Identifier: Apache-2.0
// Columns taken out of a triangle, against Eigen's factor and Schur complement.
#include "math/lower_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <random>
#include <vector>

#include "support/dense.hpp"

namespace trueaxis {
namespace {

/// Products of random columns, of condition below 1e3.
Eigen::MatrixXd random_products(Eigen::Index size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd columns(20 * size, size);
  for (double& value : columns.reshaped()) value = normal(random);
  return columns.transpose() * columns;
}

LowerTriangle triangle_of(const Eigen::MatrixXd& matrix) {
  LowerTriangle out(static_cast<std::size_t>(matrix.rows()));
  for (std::size_t j = 0; j < out.size(); ++j)
    for (std::size_t i = j; i < out.size(); ++i)
      out(i, j) = matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return out;
}

// Of well-conditioned columns rounding is a few ε of the largest entry for each of the columns.
TEST(LowerTriangle, LeavesFactorAndSchurComplement) {
  for (const Eigen::Index size : {1, 2, 7, 8, 9, 31, 64}) {
    const Eigen::MatrixXd all = random_products(size, static_cast<unsigned>(size));
    const double bound = 1e3 * static_cast<double>(size) * std::numeric_limits<double>::epsilon() *
                         all.cwiseAbs().maxCoeff();
    for (const Eigen::Index count : {Eigen::Index{0}, size / 2, size}) {
      LowerTriangle left = triangle_of(all);
      ASSERT_TRUE(left.eliminate(static_cast<std::size_t>(count)));
      const Eigen::MatrixXd first = all.topLeftCorner(count, count);
      const Eigen::MatrixXd factor = dense::cholesky(first);
      const Eigen::MatrixXd cross = all.bottomLeftCorner(size - count, count);
      const Eigen::MatrixXd rest = all.bottomRightCorner(size - count, size - count) -
                                   cross * dense::inverse(first) * cross.transpose();
      for (Eigen::Index j = 0; j < size; ++j) {
        for (Eigen::Index i = j; i < size; ++i) {
          const double found = left(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
          if (i < count) {
            EXPECT_NEAR(found, factor(i, j), bound) << size << ' ' << i << ' ' << j;
          } else if (j >= count) {
            EXPECT_NEAR(found, rest(i - count, j - count), bound) << size << ' ' << i << ' ' << j;
          }
        }
      }
    }
  }
}

TEST(LowerTriangle, SaysWhereColumnsAreNotPositiveDefinite) {
  Eigen::MatrixXd all = random_products(9, 1);
  all(4, 4) = -all(4, 4);
  EXPECT_FALSE(triangle_of(all).eliminate(9));
  EXPECT_TRUE(triangle_of(all).eliminate(4));
}

TEST(LowerTriangle, IsTheSumOfOthers) {
  const LowerTriangle a = triangle_of(random_products(13, 1)),
                      b = triangle_of(random_products(13, 2));
  LowerTriangle sum(13);
  sum.become_sum(std::vector<LowerTriangle::Part>{{2.0, &a}, {-0.5, &b}});
  for (std::size_t j = 0; j < 13; ++j)
    for (std::size_t i = j; i < 13; ++i) EXPECT_DOUBLE_EQ(sum(i, j), 2.0 * a(i, j) - 0.5 * b(i, j));
}

}  // namespace
}  // namespace trueaxis
