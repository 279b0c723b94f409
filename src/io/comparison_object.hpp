// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/json.hpp"
#include "trueaxis/job/comparison.hpp"

namespace trueaxis {

/// What every file says of a comparison: readings, discrepancies, largest lines.
Json comparison_object(const Comparison& comparison);

}  // namespace trueaxis
