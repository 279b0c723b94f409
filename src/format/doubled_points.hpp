// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

namespace trueaxis {

/// A point that is written twice is measured once: u would be too small by root 2. If the
/// steps of a probe are so coarse that half of the points agree, they hide the noise that u is
/// from.
/// @throws InputError if half of the points or more repeat another to the last bit
void refuse_doubled(std::span<const std::array<double, 3>> points, const std::string& source);

}  // namespace trueaxis
