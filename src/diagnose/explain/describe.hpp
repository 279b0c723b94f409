// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A hypothesis at its linear coefficients: all linear parameters, those not free being 0.
/// @param covariance of the coefficients, mm, rad, s; empty: not known
TermValue fitted(const Hypothesis& hypothesis, const Eigen::VectorXd& coefficients,
                 const Eigen::MatrixXd& covariance = {});

/// Of a term's coefficients.
Eigen::MatrixXd covariance_of(const Joint& joint, std::size_t term);

/// Parameters of a term with their uncertainties: those of the joint fit, and of the shape that the
/// search has refined (curvature of the profile likelihood), by the law of propagation (Eq. 84).
std::vector<FitParameter> parameters_of(const Problem& problem, const Model& model,
                                        const Joint& joint, std::size_t term);

/// A term that is not a catalogued cause.
Unexplained unexplained_of(const Joint& joint, std::size_t term);

/// The other orders that are one column with it, and the readings per revolution that tell them
/// apart: "10 or 14: with 12 readings per revolution orders n and k 12 ± n are one column; take 21
/// …". Empty: none. Eq. 76.
std::string alias_of(const Hypothesis& hypothesis, const Resolution& resolution);

}  // namespace trueaxis::diagnose_detail
