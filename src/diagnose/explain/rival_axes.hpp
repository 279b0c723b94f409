// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/regression/joint.hpp"

namespace trueaxis::diagnose_detail {

/// What the base of the named model may be off because the data cannot tell its causes from others:
/// Σ p (b_rival − b)(b_rival − b)ᵀ over the rivals of all findings, p their probability in the
/// class. The variance between models of Draper 1995 (J. R. Stat. Soc. B 57, 45), about the model
/// that is named.
Eigen::MatrixXd between_causes(const Problem& problem, const Joint& joint,
                               const std::vector<AmbiguousFinding>& questions);

}  // namespace trueaxis::diagnose_detail
