// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model/normal_matrix.hpp"

namespace trueaxis {

/// Sums over readings of a robust loss: ρ, its second derivative ψ' and its weight ψ/r.
struct LossSums {
  double rho = 0.0, curvature = 0.0, weight = 0.0;
};

/// Scales columns and residual of a block by the square root of the loss's weight.
/// Eqs. 23, 26, 27.
void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums);

}  // namespace trueaxis
