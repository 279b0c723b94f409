// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/estimate/geometry.hpp"
#include "calibrate/estimate/tip_fit.hpp"

namespace trueaxis::calibrate_detail {

/// Component errors that were not fitted, taken into a calibration (Eqs. 210-215): parameters and
/// errors become those of the regression in which every component error is random at its plausible
/// size, u and covariance what is then unknown of them. @returns the places
VectorXd take_component_errors(const TipFit& fit, const CalibrationOptions& options,
                               Calibration& out);

/// Columns of something found, and the error of size 1 that each is; none: no error of the machine.
struct FoundColumns {
  Index count = 0;
  std::vector<ErrorTerm> errors;
};

/// The covariance of kept unknowns and of what was found that are errors of the machine, from that
/// of all columns: the unknowns per largest size, the places, what was found. What was given of the
/// same is superseded.
void state_covariance(const TipFit& fit, std::span<const FoundColumns> found,
                      const MatrixXd& of_columns, ErrorModel& errors);

/// Adds an amount times `value`: amounts of one error that a function can hold together become one
/// entry.
void add_amount(std::vector<ErrorTerm>& terms, const UncertainAmount& amount, double value);

/// An error of size 1 as an amount.
UncertainAmount amount_of(const ErrorTerm& unit);

}  // namespace trueaxis::calibrate_detail
