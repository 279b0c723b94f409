// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/regression/joint.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// Before and after: the surface alone and with all terms, block by block held out.
/// @param between covariance of the base that causes add which the data cannot tell
Gain measure_gain(const Problem& problem, const Joint& joint, const Eigen::MatrixXd& between,
                  double noise_floor_mm);

}  // namespace trueaxis::diagnose_detail
