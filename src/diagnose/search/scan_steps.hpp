// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "diagnose/search/judge.hpp"

namespace trueaxis::diagnose_detail {

/// Steps between any two readings after base and terms. Every form of every effect that is a step
/// has the date that lowers the sum of squares most, from sums over the readings before it (Eq.
/// 75a). A step dated a few readings off leaves these unexplained, which costs it more in a short
/// stream than its size is worth there. Each is also
/// proposed as a slip that lasts, about its date. @param phi autoregression of the noise; the first
/// rows of a run do not count @param tests is how many independent dates of how many forms were
/// looked at
std::vector<Hypothesis> scan_steps(const Problem& problem, const std::vector<double>& phi,
                                   const std::vector<Hypothesis>& terms, double& tests);

/// Leaves one of each form of the slips that last: the first, of a list that is sorted.
void erase_other_durations(std::vector<Candidate>& list);

}  // namespace trueaxis::diagnose_detail
