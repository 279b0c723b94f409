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

/// Draws of the series from its posterior (Eq. 433): an order is absent, or has amplitudes of a
/// size, by the evidence of each, and the share of absent orders is that of all. Orders that the
/// noise hides are absent in most draws, so that they do not make a range larger.
ResolvedSeries resolve(const UncertainSeries& series);

}  // namespace trueaxis
