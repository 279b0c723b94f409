// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "correct/profile.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Findings that the job asks to be put into the correction and that may be; what became of each
/// wish goes to `result.inclusions`.
std::vector<RepeatingMotion> included_motions(JobResult& result);

}  // namespace trueaxis
