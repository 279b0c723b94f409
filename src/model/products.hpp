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

/// Partial sums of a Gram matrix, one vector of lanes an entry, lower triangle by rows.
struct LaneSums {
  static constexpr std::size_t lanes = 8;  ///< doubles in the widest vector
  alignas(64) double value[gram_size(max_columns)][lanes] = {};
};

/// Adds the products of one block's columns and residual (last row) to `sums`.
void add_products(const PredictionBlock& block, std::size_t columns, LaneSums& sums);

/// Sums over readings of a robust loss: ρ, its second derivative ψ' and its weight ψ/r.
struct LossSums {
  double rho = 0.0, curvature = 0.0, weight = 0.0;
};

/// Scales columns and residual of a block by the square root of the loss's weight.
void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums);

}  // namespace trueaxis
