// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "measure/seats.hpp"
#include "trueaxis/reason.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// That the readings of a stream that is to be one cone or cylinder are of several (find_seats).
/// @param of_seat how the remedies say the Z range of each
std::optional<Reason> not_one_surface(const ProbeStream& stream, SurfaceKind surface,
                                      ReasonCode of_seat);

/// The seats that were found.
Reason seats_reason(const Seats& seats);

}  // namespace trueaxis
