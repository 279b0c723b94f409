// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Where the second axis is, seen from the first, machine Z, part frame.
struct AxisOffset {
  double z_mm = 0.0, x_mm = 0.0, y_mm = 0.0;
  double u_mm = 0.0;  ///< standard uncertainty in its worse direction

  double size_mm() const;
};

/// How far the axes of two seats are from each other. u is of both axes as if independent: what
/// they share (probe height, zero of C) cancels, so it is rather too large.
struct SeatDistance {
  std::size_t first = 0, second = 0;        ///< references
  std::array<AxisOffset, 2> middle;         ///< of the first seat's length, of the second's
  std::array<AxisOffset, 2> worst;          ///< the larger of the ends of each seat
  double tilt_rad = 0.0, u_tilt_rad = 0.0;  ///< angle of the axes
  /// They were probed one after the other, and a part that slipped in between would show the same.
  bool slip_looks_alike = false;

  /// ISO 1101, a diameter: 2 × the worst offset of a seat's axis from the other's.
  double coaxiality_mm(std::size_t seat) const { return 2.0 * worst[seat].size_mm(); }
  double u_coaxiality_mm(std::size_t seat) const { return 2.0 * worst[seat].u_mm; }
};

/// Whether the axis of a reference may be stated: its fit converged, no unsure slip was found, and
/// nothing shows the streams to be read wrongly.
bool axis_is_known(const PlannedJob& result, std::size_t reference);

/// Every pair of cones and cylinders whose axes are known.
std::vector<SeatDistance> seat_distances(const PlannedJob& result);

}  // namespace trueaxis
