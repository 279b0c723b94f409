// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "measure/seats.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// How a user says a stretch of Z.
enum class RangesAs {
  options,  ///< --z-from-mm 0 --z-to-mm 25
  keys,     ///< z_from_mm = 0, z_to_mm = 25
};

/// @throws InputError where the readings of a stream that is to be one cone or cylinder are of
///         several (find_seats), with the Z ranges of each
void expect_one_surface(const ProbeStream& stream, SurfaceKind surface, RangesAs ranges);

/// What was found: "2 seats are in the stream (Z 0 to 25 mm, …): the radius steps by …".
std::string seats_text(const Seats& seats);

}  // namespace trueaxis
