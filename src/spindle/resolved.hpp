// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "spindle/values.hpp"

namespace trueaxis {

/// What a series may be by its readings, without their noise.
struct ResolvedSeries {
  Series mean;
  std::vector<Series> drawn;
};

/// Draws of the series from its posterior (Eq. 433): each order has amplitudes of a size, by the
/// evidence of each, and the shares of the sizes are those of all orders. Orders that the noise
/// hides are absent or small in most draws, so that they do not make a range larger.
ResolvedSeries resolve(const UncertainSeries& series);

}  // namespace trueaxis
