// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The table as revolutions and a map, harmonics, the actuator's margin.
Json correction_data(const Correction& correction);

}  // namespace trueaxis
