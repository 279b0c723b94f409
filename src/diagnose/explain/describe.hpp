// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A named value inside (mm, rad, s).
struct NamedValue {
  std::string name, unit;
  double value = 0.0;
};

/// The catalogue's parameters of a hypothesis of an effect at its linear coefficients.
std::vector<NamedValue> values_of(const Hypothesis& hypothesis,
                                  const Eigen::VectorXd& coefficients);

/// Parameters of a term with their uncertainties: those of the joint fit, and of the shape that the
/// search has refined (curvature of the profile likelihood), by the law of propagation.
std::vector<FitParameter> parameters_of(const Problem& problem, const Model& model,
                                        const Joint& joint, std::size_t term);

/// A term that is no catalogued cause.
Unexplained unexplained_of(const Joint& joint, std::size_t term);

/// "12 (sampled 15 times a revolution, orders n and 15 − n are one column)"; empty: no alias.
std::string alias_of(const Hypothesis& hypothesis, const Resolution& resolution);

/// All linear parameters of a term, those not free being 0.
std::vector<double> linear_of(const Hypothesis& hypothesis, const Eigen::VectorXd& coefficients);

}  // namespace trueaxis::diagnose_detail
