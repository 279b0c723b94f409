// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The second half of `run_job`: target axis, correction and verdict of references that are fitted
/// and, but for faces, diagnosed and measured again by the virtual lathe.
void conclude(JobResult& result);

}  // namespace trueaxis
