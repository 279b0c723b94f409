// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace trueaxis {

/// Chips: which of the residuals, in order of time, lie far off while their neighbours do not. A
/// part that moved takes its neighbours along. Those that are not finite are not far.
std::vector<bool> lone_outliers(std::span<const double> left_mm);

}  // namespace trueaxis
