// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/tip_fit.hpp"

namespace trueaxis::calibrate_detail {

/// What a tip depends on: every location error and what was found, of the largest plausible size
/// before the measurement, and what these rows do not show, of its typical one.
std::vector<UncertainParameter> uncertain_of(const TipFit& fit, const MachineDiagnosis& found,
                                             const MachineDiagnoseOptions& options);

/// Their covariance after a measurement, by rows, with the places free (Eq. 189). Empty of none.
/// @param base columns of all unknowns per largest size, then of the places, over σ
Covariance covariance_of(const TipFit& fit, const Problem& problem, const Geometry& geometry,
                         const Eigen::MatrixXd& base,
                         const std::vector<UncertainParameter>& uncertain, double variance);

}  // namespace trueaxis::calibrate_detail
