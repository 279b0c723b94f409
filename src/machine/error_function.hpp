// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/machine.hpp"

namespace trueaxis {

struct ValueAndSlope {
  double value = 0.0, slope = 0.0;  ///< slope: per mm or rad of the position
};

/// `value_at` with its derivative; at a corner of a table that of the piece above it.
ValueAndSlope value_and_slope(const ErrorFunction& function, double position);

}  // namespace trueaxis
