// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace trueaxis {

/// Where a rotation changes its speed by more than 1 %: the readings that start a new speed.
///
/// Speeds are taken over whole revolutions, so sampling jitter and a speed that swings once per
/// turn do not count. A change is a split of the revolutions into two groups whose means differ by
/// more than 1 % and by more than five standard errors of their scatter. A change inside a
/// revolution is placed where the two lines C(t) meet; a run-up of several revolutions is a speed
/// of its own; a single revolution at either end of the pass is not.
std::vector<std::size_t> find_speed_changes(std::span<const double> c_rad,
                                            std::span<const double> time_s);

}  // namespace trueaxis
