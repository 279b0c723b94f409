// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/resimulation.hpp"

namespace trueaxis {

/// What every file says of a comparison: readings, discrepancies, largest lines.
Json comparison_object(const Comparison& comparison);

}  // namespace trueaxis
