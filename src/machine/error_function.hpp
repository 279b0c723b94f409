// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/machine.hpp"

namespace trueaxis {

struct ValueAndSlope {
  double value = 0.0, slope = 0.0;  ///< slope: per mm or rad of the position
};

/// cos and sin of 2πq/P at one position q, kept from one Fourier sum to the next of its period.
struct FirstWave {
  double period = 0.0;  ///< 0: none yet
  double cos = 1.0, sin = 0.0;
};

/// `value_at` with its derivative; at a corner of a table that of the piece above it.
/// @param wave of this position
ValueAndSlope value_and_slope(const ErrorFunction& function, double position, FirstWave& wave);
double value_at(const ErrorFunction& function, double position, FirstWave& wave);

}  // namespace trueaxis
