// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/regression/joint.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// The base of the model averaged over all that may have caused the readings (Hoeting et al. 1999,
/// Statistical Science 14, 382), weighted by their probability (Eq. 95).
struct AveragedAxis {
  Eigen::VectorXd shift;          ///< of the base, against that of the named model by least squares
  Eigen::MatrixXd within;         ///< covariance of the base by the noise, sizes being plausible
  Eigen::MatrixXd between;        ///< what the causes that the data cannot tell add
  std::vector<AxisShare> shares;  ///< the models that move it, the largest first
};

/// @param findings the ambiguous terms of the joint fit
/// @param others models of other terms that explain the readings instead
/// @param ideal the fit of the surface alone: what its budget states is not averaged over
AveragedAxis average_axis(const Problem& problem, const Joint& joint,
                          const std::vector<AmbiguousFinding>& findings, const FitResult& ideal,
                          const std::vector<Otherwise>& others = {});

}  // namespace trueaxis::diagnose_detail
