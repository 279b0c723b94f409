// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/explain/confounder_set.hpp"

namespace trueaxis::diagnose_detail {

/// Effects that might be there and were not found, seen or not, but for those that the cut meets as
/// the probe did. Harmonics of free order do not count: they are not neighbours of the axis, which
/// is of order one. What is stated of an effect holds whatever the cause is.
std::vector<Hypothesis> not_found(const Problem& problem, const std::vector<Hypothesis>& terms,
                                  const std::vector<AmbiguousFinding>& findings);

}  // namespace trueaxis::diagnose_detail
