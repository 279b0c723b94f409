// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fit/minimise.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// A minimum with its residuals and, for a robust loss, the scale it was found with.
struct Association {
  Minimum minimum;
  std::optional<Minimum> rival;  ///< the lowest minimum but one, when several starts were tried
  LossScale loss;
  double scale_mm = 0.0;            ///< robust σ; 0 for plain
  std::vector<double> residual_mm;  ///< reading − prediction
};

/// Starting values from the data, then the minimum of the loss; a robust scale and the minimum are
/// found in turn until the scale stands (Huber, Robust Statistics, 1981, section 7.8).
Association associate(const JointModel& model, Loss loss, int max_iterations);

/// ψ and ψ' of a loss at a residual (Eqs. 26, 27).
struct PsiAndDerivative {
  double psi, slope;
};
PsiAndDerivative psi_and_derivative(const LossScale& loss, double residual_mm);

/// The readings without weight (Tukey), or beyond 6 σ (Huber).
std::vector<Rejected> list_rejected(const Association& association);

}  // namespace trueaxis
