// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// The radius about the axis of one turn or section of the readings, whatever its eccentricity.
struct TurnRadius {
  double z_mm = 0.0, radius_mm = 0.0;
  double spacing_mm = 0.0;            ///< to its neighbours: the feed, the median of sections
  double u_mm = 0.0;                  ///< standard uncertainty from the scatter within it
  std::vector<std::size_t> readings;  ///< those in it
};

/// A stream as a profile along Z.
struct SeatProfile {
  std::vector<TurnRadius> turns;  ///< along Z
  double noise_mm = 0.0;          ///< standard deviation of a turn's radius
  bool sections = false;          ///< at standing Z, not along a helix
};

/// A circle in C, a + b cos C + c sin C, through readings; outliers without weight (Tukey).
struct RobustCircle {
  double radius_mm = 0.0, cos_mm = 0.0, sin_mm = 0.0;
  double scatter_mm = 0.0;  ///< 1.4826 median |residual|

  double at(double c_rad) const;
};

RobustCircle robust_circle(const ProbeStream& stream, const std::vector<std::size_t>& readings);

/// Turns that are covered by less than two thirds of C have no radius and do not count.
SeatProfile seat_profile(const ProbeStream& stream);

}  // namespace trueaxis
