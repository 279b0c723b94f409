// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/prepared_stream.hpp"
#include "surface/surface.hpp"

namespace trueaxis {
/// How a residual r counts: ρ(r) with weight ψ(r)/r. `scale_mm` is not used by plain.
struct LossScale {
  enum class Kind { plain, huber, tukey } kind = Kind::plain;
  double threshold_mm = 0.0;  ///< Huber: where it turns linear; Tukey: where the weight ends
};

/// JᵀWJ, JᵀWr and Σρ over a stream, with J the Jacobian of the prediction.
struct NormalMatrix {
  std::size_t parameters = 0;
  std::vector<double> jtj;  ///< row-major, symmetric
  std::vector<double> jtr;
  double sum_rho = 0.0;  ///< Σρ, plain: Σr²
  /// Σψ' / Σ(ψ/r): what the weights overstate the curvature of a robust loss by, as ψ' and J are
  /// nearly independent; curvature · JᵀWJ is the Hessian up to O(1/√N). 1 for plain.
  double curvature = 1.0;
  bool valid = false;  ///< false: a probe line misses the surface at these parameters
};

/// One pass over the stream: root, basis, products, block by block in the first cache; sums are
/// formed per block and then over blocks, always in the same order.
NormalMatrix accumulate(const Surface& surface, std::span<const double> working,
                        const PreparedStream& stream, const LossScale& loss);

/// Reading − prediction, one per reading. @returns false where a probe line misses the surface.
bool residuals(const Surface& surface, std::span<const double> working,
               const PreparedStream& stream, std::span<double> out_mm);

/// Sums over readings of a robust loss: ρ, its second derivative ψ' and its weight ψ/r.
struct LossSums {
  double rho = 0.0, curvature = 0.0, weight = 0.0;
};

/// Scales columns and residual of a block by the square root of the loss's weight.
/// Eqs. 23, 26, 27.
void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums);

}  // namespace trueaxis
