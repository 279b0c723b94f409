// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// What went in: streams with hash, options of fit, tool and actuator, as label and text.
Json inputs_data(const JobResult& result);

}  // namespace trueaxis
