// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Measured against simulated, before and after: discrepancy, spectrum, maps; null where the model
/// was not evaluated at every reading.
/// @param again by the virtual lathe; none: the model stands for it
Json simulation_data(const ProbeStream& stream, const Diagnosis& diagnosis,
                     const Resimulation* again);

}  // namespace trueaxis
