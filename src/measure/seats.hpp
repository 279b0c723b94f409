// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A stretch of Z, machine frame, mm, both ends in it.
struct ZRange {
  double from_mm = -std::numeric_limits<double>::infinity();
  double to_mm = std::numeric_limits<double>::infinity();

  bool holds(double z_mm) const { return from_mm <= z_mm && z_mm <= to_mm; }
  bool everywhere() const { return !std::isfinite(from_mm) && !std::isfinite(to_mm); }
};

/// A straight surface of revolution among others in one stream.
struct Seat {
  ZRange z;  ///< its readings follow it from end to end
  std::size_t readings = 0;
};

/// What parts two neighbouring stretches.
struct SeatBreak {
  enum class Kind {
    gap,    ///< nothing was read between them
    step,   ///< the radius jumps: a shoulder, an edge of a groove
    slope,  ///< the taper changes
  } kind = Kind::gap;
  double z_mm = 0.0;          ///< where
  double step_mm = 0.0;       ///< of the radius, towards +Z
  double slope_change = 0.0;  ///< of dR/dZ, mm/mm, towards +Z
};

/// The seats of a stream along Z, and what parts them. Neither: one surface.
struct Seats {
  std::vector<Seat> seats;
  std::vector<SeatBreak> breaks;  ///< all of them, those at an end of the stream too
  std::vector<Seat> left_out;     ///< more than a transition, and of no seat

  /// Whether one cone or cylinder cannot be all of it: a break that is more than a gap.
  bool broken() const;
};

/// Finds the seats by breaks in Z, in radius and in slope (theory, "Seats in one stream"). A stream
/// of a face, of several clampings, or without turns or sections along Z has none.
Seats find_seats(const ProbeStream& stream);

/// The readings of a stretch, every column; the stream says in `read_as` what was excluded.
/// @throws InputError where none lies in it
ProbeStream within(const ProbeStream& stream, const ZRange& range);

}  // namespace trueaxis
