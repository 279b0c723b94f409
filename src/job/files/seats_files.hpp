// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The axis of a reference at the ends of its length: offset from the spindle axis, tilt, where to
/// tap; null where it is not known.
Json seat_axis_object(const JobResult& result, std::size_t reference);

/// How far the axes of each two seats are apart.
Json seats_apart_array(const JobResult& result);

/// The same for a terminal: lines "axis", "tap", "ecc", "apart", "coax"; empty where not known.
std::string seat_axis_screen(const JobResult& result, std::size_t reference);
std::string seats_apart_screen(const JobResult& result);

}  // namespace trueaxis
