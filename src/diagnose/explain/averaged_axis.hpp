// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/explain/observable.hpp"
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

/// Where nothing was found it is the ideal fit.
/// @param findings the ambiguous terms of the joint fit
/// @param hidden effects that the plan would not show at their largest: they are listed apart
AveragedAxis average_axis(const Problem& problem, const Joint& joint,
                          const std::vector<AmbiguousFinding>& findings,
                          const std::vector<Unobservable>& hidden);

}  // namespace trueaxis::diagnose_detail
