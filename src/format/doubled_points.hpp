// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

namespace trueaxis {

/// A point that is written twice is measured once: u would be too small by root 2. Some points
/// agree if the steps of the probe are coarse, but never half of them.
/// @throws InputError if half of the points or more repeat another to the last bit
void refuse_doubled(std::span<const std::array<double, 3>> points, const std::string& source);

}  // namespace trueaxis
