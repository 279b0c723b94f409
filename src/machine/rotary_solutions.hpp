// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "machine/compiled.hpp"

namespace trueaxis {

/// Positions of the rotary axes that give the tool a direction.
struct RotarySolution {
  AxisPositions axes{};             ///< the linear ones at 0
  std::optional<std::size_t> free;  ///< an axis that may be anywhere: a pole
};

/// All of one turn: of the chain exp(q₁ u₁) … exp(qₘ uₘ) t = d with t the tool's direction, d the
/// target's, both in M. Two axes by the intersection of two cones (Paden and Kahan's second
/// subproblem), one by its angle; of three the first stays as `near` has it. Empty: none.
std::vector<RotarySolution> rotary_solutions(const MachineModel::Compiled& machine,
                                             const Eigen::Vector3d& direction,
                                             const AxisPositions& near);

}  // namespace trueaxis
