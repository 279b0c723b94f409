// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "correct/profile.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

struct IncludedMotions {
  std::vector<RepeatingMotion> motions;
  std::vector<Inclusion> inclusions;  ///< what became of each wish
};

/// Causes that the job asks to be put into the correction and that may be.
IncludedMotions included_motions(const IdentifiedJob& job);

}  // namespace trueaxis
