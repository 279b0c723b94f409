// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// Asks for the stock where the target lies on the probed length of a reference of its own side
/// (shaft or bore; a face on a face), because only then can be told what the tool meets.
/// @throws InputError that says so, when the job does not state it.
void require_stock(const PlannedJob& job);

// What forbids a cut, seen from the geometry alone: the probed surface, the ball, the target and
// the stock that was stated.
extern const JobCheck cut_refused, surface_behind_ball, material_between, stock, cut_too_far;

// What the geometry does not forbid and the reader of a go must know.
extern const JobCheck cut_far, gauge_shows_no_radius;

}  // namespace trueaxis
