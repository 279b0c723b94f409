// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "correct/profile.hpp"

namespace trueaxis {

/// Counts one revolution in: how far off at an even number of evenly spaced angles, mm. Between two
/// nodes of a table, which are at even ones, the deviation is nearly a parabola.
void add_revolution(Deviation& worst, const std::vector<double>& off_mm);

/// First rows' revolutions to look at, first and last among them: enough that amplitudes that
/// change linearly along the cut are met at their largest, and at most about `most` points in all.
std::vector<std::size_t> looked_at(std::size_t revolutions, std::size_t points_of_one);

/// Steps from one of `per_revolution` nodes to the next: an even number, so that the middle of two
/// nodes is looked at, and 64 or more in a revolution.
std::size_t parts_between(std::size_t per_revolution);

/// Of straight lines between `rows` wanted values a revolution (Eq. 114a), or of values that are
/// held until the next (Eq. 114b).
Deviation between_rows(const Profile& profile, int rows, Interpolation by);

}  // namespace trueaxis
