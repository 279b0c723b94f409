// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/surface/axis.hpp"

namespace trueaxis {

/// A right circular cone (or, with tan_half_angle = 0, a cylinder) about an axis. s runs along the
/// axis with s = 0 at (axis.x, axis.y, axis.z_ref); radius(s) = radius_mm + tan_half_angle · s.
struct Revolved {
  Axis axis;
  double radius_mm = 0.0;
  double tan_half_angle = 0.0;  ///< signed: positive where the radius grows with s
};

/// Where a line parallel to X meets a surface.
struct Intersection {
  double x_mm = 0.0;   ///< machine X, a radius
  double dx_dz = 0.0;  ///< along Z at fixed C, mm per mm
  double dx_dc = 0.0;  ///< along C at fixed Z, mm per rad
  bool hit = false;    ///< false: the line passes the surface by, or meets the mirrored nappe only
};

enum class Root {
  front,
  rear
};  ///< front: the larger X, where a tool in front works; rear: the smaller

/// Exact intersection at spindle angle C and height Z of the line Y = height parallel to X
/// (effects.md's quadratic with K = 1 + tan²(half angle), no tilt of the line).
Intersection intersect(const Revolved& surface, double c_rad, double z_mm, double height_mm = 0.0,
                       Root root = Root::front);

}  // namespace trueaxis
