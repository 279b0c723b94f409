// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/job/job.hpp"

namespace trueaxis {

/// Schema trueaxis.run/1: verdict, fits, target axis with what is left at each reference, harmonics
/// of the correction and the actuator's margin.
std::string job_json(const JobResult& result);

}  // namespace trueaxis
