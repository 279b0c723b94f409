// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "measure/centre_step.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// U of the axis at the end where it is larger; of a plane what its tilt makes there.
double U_of_axis_mm(const FitResult& fit);

/// That the part moved within a pass, by more than U of the axis: its axis is then that of neither
/// place (Eq. 314). None: it stood still, or bends.
/// @param left_mm what the model of the readings leaves, one each
/// @param by_chance the probability that noise shows a move
std::optional<CentreStep> moved_in_pass(const ProbeStream& stream, std::span<const double> left_mm,
                                        const FitResult& fit, double by_chance = 1e-3);

}  // namespace trueaxis
