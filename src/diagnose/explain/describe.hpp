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
/// search has refined (curvature of the profile likelihood), by the law of propagation.
std::vector<FitParameter> parameters_of(const Problem& problem, const Model& model,
                                        const Joint& joint, std::size_t term);

/// A term that is no catalogued cause.
Unexplained unexplained_of(const Joint& joint, std::size_t term);

/// "12 (sampled 15 times a revolution, orders n and 15 − n are one column)"; empty: no alias.
std::string alias_of(const Hypothesis& hypothesis, const Resolution& resolution);

}  // namespace trueaxis::diagnose_detail
