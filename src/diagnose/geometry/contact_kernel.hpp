// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "trueaxis/surface.hpp"

namespace trueaxis::diagnose_detail {

/// Room after a column that a kernel works on: vectors of the last readings reach into it.
inline constexpr std::size_t kernel_room = 8;

/// Probe lines, and where they meet a surface: as `intersect` says, all at once.
struct ProbeLines {
  const double *sine, *cosine, *z;  ///< of C; mm
  double *x, *dx_dc, *dx_dz;        ///< written
  double height_mm;                 ///< of all
};
/// @returns whether all of them meet it
bool meet(const Revolved& shape, Root root, const ProbeLines& lines, std::size_t count);

/// Points (x, y, z) of the machine, turned back by C into the frame of the spindle.
struct TurnedPoints {
  const double *x, *z, *sine, *cosine;
  double *theta, *along, *from;  ///< written: polar angle about an axis, along it, from it
  double y;                      ///< of all
};
/// Their coordinates in the frame of an axis, whose origin is the axis' point at z = 0: turned back
/// by Rodrigues' rotation about the common normal of axis and spindle. On the axis θ is 0.
void to_part_frame(const Axis& axis, const TurnedPoints& points, std::size_t count);

}  // namespace trueaxis::diagnose_detail
