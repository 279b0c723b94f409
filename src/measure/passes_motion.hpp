// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Sense of motion of both axes from one reading to the next: -1, 0, +1.
struct StepSigns {
  std::vector<signed char> c, feed;  ///< one less than readings; feed all 0 without position
};

/// Senses of the steps between readings [begin, end).
///
/// Single steps of a recorded axis say little: noise and resolution turn their sign. So a stretch
/// is at rest where the axis stays within a tolerance over a whole window (feed: one turn of C; C,
/// and a feed while C rests: 32 readings), and elsewhere its sense changes only where it comes back
/// by more than that tolerance. The tolerance is ten times the noise of the window, estimated from
/// second differences, so it follows the typical step's jitter; at least 5 µm for a feed, 1e-4 rad
/// for C; at least the resolution (the least step) and at most 50 µm and 0.1 rad. So a feed below
/// 5 µm per revolution counts as none.
///
/// A feed step four times longer than all feed within nearly a turn on both sides is a positioning
/// move; windows end at it. A rest may so reach a few readings into the feed next to it. Readings
/// that go along Z while C stays within 1e-4 rad are at rest in C.
StepSigns find_step_signs(const ProbeStream& stream, std::size_t begin, std::size_t end);

/// Where a rotation changes its speed by more than 1 %: the readings that start a new speed.
///
/// Speeds are over whole revolutions, so sampling jitter and a speed that swings once per
/// revolution do not count. A change is a split of the revolutions into two groups whose means
/// differ by more than 1 % and by more than five standard errors of their scatter. A change inside
/// a revolution is placed where the two lines C(t) meet; a run-up of several revolutions is a speed
/// of its own; a single revolution at either end of the pass is not.
std::vector<std::size_t> find_speed_changes(std::span<const double> c_rad,
                                            std::span<const double> time_s);

}  // namespace trueaxis
