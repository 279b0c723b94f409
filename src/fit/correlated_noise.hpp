// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "fit/associate.hpp"

namespace trueaxis {

/// The noise of the readings as an autoregression, and what it makes of the normal matrix.
struct CorrelatedNoise {
  std::vector<double> phi;  ///< φ of ε_i = Σ φ_j ε_{i−j} + e_i
  Eigen::MatrixXd jtcj;     ///< JᵀCJ, C the correlation matrix of the noise of all readings
};

/// The autoregression of residuals clipped at ± `clip_mm`; excluded readings do not count. There is
/// none if too few readings follow each other, if these are white, or if the residuals ring with
/// the spindle: that is form, not noise (Eqs. 34a, 65).
std::optional<CorrelatedNoise> find_correlated_noise(const JointModel& model,
                                                     const Association& association,
                                                     double clip_mm);

}  // namespace trueaxis
