// SPDX-License-Identifier: Apache-2.0
#include "model/loss.hpp"

#include <algorithm>
#include <cmath>

#include "math/gram.hpp"

namespace trueaxis {

void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums) {
  alignas(64) double root_weight[block_size] = {};
  const double c = loss.threshold_mm;
  for (std::size_t i = 0; i < filled; ++i) {
    const double r = std::abs(block.residual[i]);
    if (loss.kind == LossScale::Kind::huber) {
      const double weight = r <= c ? 1.0 : c / r;
      root_weight[i] = std::sqrt(weight);
      sums.rho += r <= c ? r * r : c * (2.0 * r - c);
      sums.weight += weight;
      sums.curvature += r <= c ? 1.0 : 0.0;
    } else {
      const double v = (r / c) * (r / c), u = std::max(0.0, 1.0 - v);
      root_weight[i] = u;
      sums.rho += c * c / 3.0 * (1.0 - u * u * u);
      sums.weight += u * u;
      sums.curvature += u * (1.0 - 5.0 * std::min(v, 1.0));
    }
  }
  double* column[max_columns + 1];
  for (std::size_t i = 0; i < columns; ++i) column[i] = block.column[i];
  column[columns] = block.residual;
  scale_columns(root_weight, columns + 1, column);
}

}  // namespace trueaxis
