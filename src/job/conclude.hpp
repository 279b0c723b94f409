// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The second half of `run_job`: target axis, correction and verdict of references that are fitted
/// and, but for faces, diagnosed and measured again by the virtual lathe.
JobResult conclude(IdentifiedJob identified, std::vector<PartForm> forms = {});

}  // namespace trueaxis
