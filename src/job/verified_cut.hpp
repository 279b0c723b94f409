// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The cut seat as it is probed again in the clamping of the cut.
struct VerifiedCut {
  LoopObservation seen;
  std::vector<std::string> corrected;   ///< ids of causes in the probe that its axis is without
  double off_mm = 0.0, U_off_mm = 0.0;  ///< largest over the cut, from the target axis
};

/// @param form readings of the cut about its own axis, measured elsewhere in the part's own C; or
/// none
/// @throws Refusal where the readings do not tell the axis of the cut, and where the target axis is
/// on the spindle axis
VerifiedCut verified_cut(const JobResult& result, const ProbeStream& probed_again,
                         const ProbeStream* form = nullptr);

/// Ids of the causes in probe and encoders by which the axes of the references were corrected.
std::vector<std::string> corrected_causes(const JobResult& result);

/// Mean spindle speed of the references' passes with the sign of C, rad/s; 0: they have no t.
double probing_speed(const std::vector<ProbeStream>& streams);

}  // namespace trueaxis
