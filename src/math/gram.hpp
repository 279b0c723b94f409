// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <iterator>
#include <numeric>

namespace trueaxis {

/// Readings worked on at a time: a block of all columns stays in the first cache.
inline constexpr std::size_t block_size = 128;
inline constexpr std::size_t max_gram_columns = 9;

/// Place of an entry of a symmetric matrix kept as its lower triangle by rows, row ≥ column.
constexpr std::size_t gram_index(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}
constexpr std::size_t gram_size(std::size_t columns) { return columns * (columns + 1) / 2; }

/// Partial sums of a Gram matrix, one vector of lanes an entry.
struct LaneSums {
  static constexpr std::size_t lanes = 8;  ///< doubles in the widest vector
  alignas(64) double value[gram_size(max_gram_columns)][lanes] = {};

  double sum(std::size_t index) const {
    return std::reduce(std::begin(value[index]), std::end(value[index]));
  }
};

/// Adds the products of every pair of columns over a block; columns are 64-byte aligned and
/// block_size long.
void add_products(const double* const* column, std::size_t columns, LaneSums& sums);

/// Multiplies every column of a block by `factor`, reading by reading.
void scale_columns(const double* factor, std::size_t columns, double* const* column);

}  // namespace trueaxis
