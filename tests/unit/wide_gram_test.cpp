// SPDX-License-Identifier: Apache-2.0
// Products of wide blocks against a plain loop, on every instruction set.
#include "math/wide_gram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "laws/targets.hpp"
#include "math/gram.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct alignas(64) Line {
  double value[8] = {};
};

/// Random columns, padded with zeros to whole lines of 64 bytes.
class RandomBlock {
 public:
  RandomBlock(std::size_t columns, std::size_t rows, std::mt19937_64& random)
      : lines_((rows + 7) / 8), data_(columns * lines_), rows_(rows) {
    std::normal_distribution<double> normal;
    for (std::size_t j = 0; j < columns; ++j) {
      double* column = data_[j * lines_].value;
      for (std::size_t i = 0; i < rows; ++i) column[i] = normal(random);
      columns_.push_back(column);
    }
  }

  WideBlock block() const { return {columns_, rows_}; }

 private:
  std::size_t lines_;
  std::vector<Line> data_;
  std::size_t rows_;
  std::vector<const double*> columns_;
};

struct Product {
  long double sum = 0.0L;
  double bound = 0.0;  ///< n ε |a| |b|
};

Product plain(const WideBlock& a, std::size_t i, const WideBlock& b, std::size_t j) {
  long double sum = 0.0L, aa = 0.0L, bb = 0.0L;
  for (std::size_t k = 0; k < a.rows; ++k) {
    const long double x = a.column[i][k], y = b.column[j][k];
    sum += x * y, aa += x * x, bb += y * y;
  }
  const auto n = static_cast<double>(a.rows);
  return {sum, n * epsilon * static_cast<double>(std::sqrt(aa * bb))};
}

TEST(WideGram, SymmetricProductsAreThoseOfAPlainLoop) {
  constexpr unsigned seed = 41;
  std::mt19937_64 random(seed);
  for (const std::size_t columns : {1u, 2u, 5u, 6u, 7u, 13u, 31u}) {
    for (const std::size_t rows : {1u, 8u, 100u, 256u, 700u}) {
      const RandomBlock data(columns, rows, random);
      const WideBlock block = data.block();
      laws::for_every_target([&](const char* target) {
        std::vector<double> lower(gram_size(columns));
        add_wide_products(block, lower);
        for (std::size_t i = 0; i < columns; ++i) {
          for (std::size_t j = 0; j <= i; ++j) {
            const Product expected = plain(block, i, block, j);
            EXPECT_NEAR(lower[gram_index(i, j)], static_cast<double>(expected.sum), expected.bound)
                << target << " seed " << seed << ' ' << columns << " x " << rows << ' ' << i << ' '
                << j;
          }
        }
      });
    }
  }
}

TEST(WideGram, CrossProductsAreThoseOfAPlainLoop) {
  constexpr unsigned seed = 42;
  std::mt19937_64 random(seed);
  for (const std::size_t rows : {3u, 256u, 515u}) {
    for (const std::size_t left_columns : {0u, 1u, 4u, 11u}) {
      for (const std::size_t right_columns : {0u, 1u, 3u, 6u, 7u, 14u}) {
        const RandomBlock a(left_columns, rows, random), b(right_columns, rows, random);
        laws::for_every_target([&](const char* target) {
          std::vector<double> out(left_columns * right_columns);
          add_cross_products(a.block(), b.block(), out);
          for (std::size_t i = 0; i < left_columns; ++i) {
            for (std::size_t j = 0; j < right_columns; ++j) {
              const Product expected = plain(a.block(), i, b.block(), j);
              EXPECT_NEAR(out[i * right_columns + j], static_cast<double>(expected.sum),
                          expected.bound)
                  << target << " seed " << seed << " rows " << rows << ' ' << i << ' ' << j;
            }
          }
        });
      }
    }
  }
}

TEST(WideGram, ASecondBlockIsAddedAndBitsRepeat) {
  constexpr unsigned seed = 43;
  std::mt19937_64 random(seed);
  const RandomBlock first(9, 300, random), second(9, 64, random);
  laws::for_every_target([&](const char* target) {
    std::vector<double> both(gram_size(9)), again(gram_size(9)), one(gram_size(9)),
        two(gram_size(9));
    for (auto* lower : {&both, &again}) {
      add_wide_products(first.block(), *lower);
      add_wide_products(second.block(), *lower);
    }
    EXPECT_EQ(both, again) << target;
    add_wide_products(first.block(), one);
    add_wide_products(second.block(), two);
    for (std::size_t k = 0; k < both.size(); ++k) {
      // 64 rows are one chunk, added in one rounding.
      EXPECT_EQ(both[k], one[k] + two[k]) << target << " seed " << seed << ' ' << k;
    }
  });
}

TEST(WideGram, AResultOfTheWrongSizeIsABrokenContract) {
  std::mt19937_64 random(44);
  const RandomBlock a(3, 16, random), b(2, 8, random);
  std::vector<double> out(6);
  EXPECT_NO_THROW(add_wide_products(a.block(), out));
  EXPECT_THROW(add_wide_products(b.block(), out), ContractViolation);
  EXPECT_THROW(add_cross_products(a.block(), b.block(), out), ContractViolation);
}

}  // namespace
}  // namespace trueaxis
