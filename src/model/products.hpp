// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/model/normal_matrix.hpp"

namespace trueaxis {

/// Number of sums of `columns` basis functions and the residual: the lower triangle of their Gram
/// matrix.
constexpr std::size_t gram_size(std::size_t columns) { return (columns + 1) * (columns + 2) / 2; }
constexpr std::size_t gram_index(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}

/// Adds the Gram matrix of one block's columns and residual (last row) to `gram`, lower triangle by
/// rows.
void add_products(const PredictionBlock& block, std::size_t columns, double* gram);

/// Scales columns and residual of a block by the square root of the loss's weight. @returns Σρ.
double apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                  PredictionBlock& block);

}  // namespace trueaxis
