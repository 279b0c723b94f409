// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/regression/size_prior.hpp"

namespace trueaxis::diagnose_detail {

/// Effects that might be there and were not found, seen or not, but for those that the cut meets as
/// the probe did. Harmonics of free order do not count: they are not neighbours of the axis, which
/// is of order one. What is stated of an effect holds whatever the cause is.
std::vector<Hypothesis> not_found(const Problem& problem, const std::vector<Hypothesis>& terms,
                                  const std::vector<AmbiguousFinding>& findings);

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
