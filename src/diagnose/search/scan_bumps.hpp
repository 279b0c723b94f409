// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// Sums of what is left over windows in (θ, s): where a local form may be. The best window of every
/// size; `tests` is how many were looked at.
std::vector<Hypothesis> scan_bumps(const NormalEquations& equations,
                                   std::span<const double> remainder_mm, double& tests);

}  // namespace trueaxis::diagnose_detail
