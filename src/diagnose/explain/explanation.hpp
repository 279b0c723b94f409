// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/search/coarse_to_fine.hpp"
#include "diagnose/search/search.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// What the terms of a model are, how large they are, and what they do to the axis.
struct Explanation {
  std::vector<Finding> findings;            ///< in the order of the model
  std::vector<AmbiguousFinding> ambiguous;  ///< one per cause
  std::vector<Unexplained> unexplained;     ///< terms that no catalogued cause explains
  /// What dropped causes would do to the axis that fit the readings nearly as well, at a size that
  /// is improbable but possible.
  std::vector<AxisShare> improbable;
};

/// @param fit of the search's model
Explanation explain(CoarseToFineSearch& search, const RelinearisedFit& fit,
                    const std::optional<Timing>& timing);

/// The model with a rival cause in the place of a term that it all but excludes about the part: the
/// search named it about the ideal fit. None: every cause is in its own class.
std::optional<Model> with_likeliest_rival(const Model& model, const Explanation& explanation);

/// A cause that is more than 20 times as large as the largest size of every cause in its class;
/// empty: there is none. A cause whose size is not a length counts as possible, and so does a slip.
std::string implausible_size(const Diagnosis& diagnosis);

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

/// The entry with what is stated of its one parameter. After the correction by the value, the rest
/// may be as far below 0 as the value is above the least that the parameter may be.
Effect as_stated(Effect effect, const Influence& influence);

/// Statements that a cause contradicts: the named cause is that of the statement, or its twin that
/// cancels what was stated, and what remains is beyond what is stated and found. @param entries
/// as_stated()
std::vector<RefutedStatement> refuted_statements(const std::vector<Finding>& findings,
                                                 std::span<const Effect> entries);

}  // namespace trueaxis::diagnose_detail
