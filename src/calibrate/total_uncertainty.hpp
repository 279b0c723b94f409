// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/tip_fit.hpp"

namespace trueaxis::calibrate_detail {

/// Component errors that were not fitted, taken into a calibration (Eqs. 210-215): parameters and
/// errors become those of the regression in which every component error is random at its plausible
/// size, u and covariance what is then unknown of them. @returns the places
Eigen::VectorXd take_component_errors(const TipFit& fit, Calibration& out);

/// An error of size 1 as an amount.
UncertainAmount amount_of(const ErrorTerm& unit);

}  // namespace trueaxis::calibrate_detail
