// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "job/machine_loop.hpp"

namespace trueaxis {

/// What a finished cut, measured elsewhere about its own axis, was moved by when it was cut: less
/// its form, order by order (Eq. 326).
/// @param stream of the cut in the part's own C @throws Refusal where it shows no form
std::vector<LearnedMotion> motion_of_form(const ProbeStream& stream, const FitOptions& options);

/// The orders in which the parts agree: forms of their own would agree so far in one of 100 loops
/// (Eq. 327). One part alone does not tell its own form from a motion.
std::vector<LearnedMotion> motion_response(const MachineLoop& loop);

/// What the form of a cut contradicts. The tool may follow an order n late by n times the lag.
LoopTrouble motion_trouble(const LoopResponse& used, const LoopObservation& seen);

void learn_motion(MachineLoop& loop, const LoopResponse& used, const LoopObservation& seen);

/// For the correction to follow.
std::vector<RepeatingMotion> followed(const std::vector<LearnedMotion>& motion);

}  // namespace trueaxis
