// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// Steps between any two readings beside base and terms: of every form of every effect that is a
/// step the date that takes most off the sum of squares, from sums over the readings before it
/// (Eq. 75a). A step dated a few readings off leaves them behind, which costs it more in a short
/// stream than its size is worth there.
/// @param phi autoregression of the noise; where a run begins its rows are left out
/// @param tests is how many independent dates of how many forms were looked at
std::vector<Hypothesis> scan_steps(const Problem& problem, const std::vector<double>& phi,
                                   const std::vector<Hypothesis>& terms, double& tests);

}  // namespace trueaxis::diagnose_detail
