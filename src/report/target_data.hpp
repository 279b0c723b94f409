// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Coaxiality of each reference before and after, the axes over the length to be cut.
Json target_data(const JobResult& result);

}  // namespace trueaxis
