// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/joint_model.hpp"

namespace trueaxis {

/// Where Levenberg-Marquardt ended.
struct Minimum {
  std::vector<double> working;  ///< joint parameters: the working ones of all set-ups
  NormalMatrix normal;          ///< at `working`
  int iterations = 0;
  bool converged = false;
};

/// Minimises ½Σρ(reading − prediction) with Ceres' Levenberg-Marquardt on the (p + 1)-row factor of
/// the normal matrix: the same minimum as one residual a reading, without ever holding N residuals.
Minimum minimise(const JointModel& model, std::vector<double> start, const LossScale& loss,
                 int max_iterations);

/// Newton steps from a minimum of a robust loss until they are below 1e-9 of the noise. Near the
/// minimum the gradient is exact where the cost, which Ceres goes by, already drowns in its
/// rounding.
void polish(const JointModel& model, const LossScale& loss, Minimum& minimum);

}  // namespace trueaxis
