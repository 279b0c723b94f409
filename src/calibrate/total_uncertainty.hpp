// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/term.hpp"
#include "calibrate/tip_fit.hpp"

namespace trueaxis::calibrate_detail {

/// Component errors that were not fitted, taken into a calibration (Eqs. 210-215): parameters and
/// errors become those of the regression in which every component error is random at its plausible
/// size, u and covariance what is then unknown of them. @returns the places
Eigen::VectorXd take_component_errors(const TipFit& fit, Calibration& out);

/// The covariance of kept unknowns and found terms that are errors of the machine, from that of all
/// columns: the unknowns per largest size, the places, the terms. What was given of the same is
/// superseded.
void state_covariance(const TipFit& fit, const std::vector<Term>& terms,
                      const std::vector<std::size_t>& found, const Eigen::MatrixXd& of_columns,
                      ErrorModel& errors);

/// An error of size 1 as an amount.
UncertainAmount amount_of(const ErrorTerm& unit);

}  // namespace trueaxis::calibrate_detail
