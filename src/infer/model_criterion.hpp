// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "infer/size_prior.hpp"

namespace trueaxis::infer {

inline constexpr double catalogue_first = 4.0;  ///< 2 ln of the odds that a pattern is no new cause
inline constexpr double better_by = 0.5;        ///< of the criterion, for a term to be exchanged

/// What data and prior say of a term of a model beside what a projection took out; its choice among
/// many is in the criterion.
using WeighTerm = std::function<Weighed(std::size_t term, const Projection& beside)>;

/// ν ln RSS, and what prior and choice of each term cost: what two models with the same noise are
/// compared by (Eq. 81).
/// @param count rows of the equations
/// @param one_width of terms that share their columns the width of all together is taken, not the
/// sum of what each has beside the others (Eq. 82a)
double model_criterion(const Eigen::MatrixXd& gram, const Columns& base,
                       const std::vector<Columns>& terms, std::size_t count,
                       const WeighTerm& weigh_term, bool one_width = false);

/// Base and terms but one; `but` = terms.size(): all.
Columns besides(const Columns& base, const std::vector<Columns>& terms, std::size_t but);

}  // namespace trueaxis::infer
