// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace trueaxis {

/// Columns of a wide block: 64-byte aligned, `rows` values each, padded with zeros to the next
/// multiple of 8. Worked on 256 rows at a time, so blocks of a multiple of 256 rows are best.
struct WideBlock {
  std::span<const double* const> column;
  std::size_t rows = 0;
};

/// lower[gram_index(i, j)] += column i · column j for every j ≤ i. The order of summation depends
/// on the instruction set and on the shape of the block only. Error of an entry: at most
/// n ε |column i| · |column j| over the n readings added so far.
/// @throws ContractViolation unless lower has gram_size(columns) entries.
void add_wide_products(const WideBlock& block, std::span<double> lower);

/// out[i · right.column.size() + j] += left.column[i] · right.column[j]; rows of one number.
void add_cross_products(const WideBlock& left, const WideBlock& right, std::span<double> out);

}  // namespace trueaxis
