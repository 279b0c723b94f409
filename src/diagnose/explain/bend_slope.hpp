// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnose/regression/size_prior.hpp"

namespace trueaxis::diagnose_detail {

/// The gain that a sensor which bends has where it was read: nothing says about which place it
/// bends (Eq. 95d). None: a gain is stated or was found.
std::optional<Hypothesis> slope_beside(const Problem& problem,
                                       const std::vector<Hypothesis>& terms);

/// Whether it bends about a place of its range.
bool bends_about_a_place(const Hypothesis& h);

/// How large that gain may be.
/// @param size of the bend
SizePrior slope_prior(const Hypothesis& bend, const Weighed& size);

}  // namespace trueaxis::diagnose_detail
