// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

namespace trueaxis::form {

/// Standard deviation of a height, from the distance of each point from a surface (or line) of
/// second degree through its nearest neighbours (Eq. 274a): the same in any order of the points. 0
/// where there are too few.
/// @param at_mm two coordinates of each height, of a line one (the second is 0)
double noise_of_points_mm(std::span<const std::array<double, 2>> at_mm, bool plane,
                          std::span<const double> height_mm);

}  // namespace trueaxis::form
