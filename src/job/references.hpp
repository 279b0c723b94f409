// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The references of a job with a target as the target axis sees them: axis of the fit used,
/// weight, and the radius at which a tilt counts.
std::vector<Reference> references_of(const JobResult& result);

}  // namespace trueaxis
