// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The most telling measurement that the diagnoses ask for; none where the part slipped, for it has
/// to be clamped again first.
const NextMeasurement* next_measurement(const JobResult& result);

}  // namespace trueaxis
