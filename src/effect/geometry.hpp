// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "trueaxis/effect/term.hpp"

/// The contact of reading i, from X(C, Z) and its slopes alone: seen by the machine, the surface is
/// a height X over (Y, Z) whatever its kind. Its gradient along Y follows from turning it:
/// ∂X/∂C = Y + X ∂X/∂Y at Y = h, with x = X cos C − Y sin C.
namespace trueaxis::contact {

inline double dx_dy(const TermContext& at, std::size_t i) {
  return (at.dx_dc[i] - at.height_mm) / at.x_mm[i];
}

/// 1/|n_x| of the unit normal.
inline double secant(const TermContext& at, std::size_t i) {
  return std::sqrt(1.0 + dx_dy(at, i) * dx_dy(at, i) + at.dx_dz[i] * at.dx_dz[i]);
}

/// Form is positive away from the part's axis: at the rear that is towards smaller X.
inline double dx_dform(const TermContext& at, std::size_t i) {
  return at.rear ? -secant(at, i) : secant(at, i);
}

/// Sign of X out of the material.
inline double away(const TermContext& at) { return at.rear == at.bore ? 1.0 : -1.0; }

/// Machine X when the part moves along x and y of the spindle frame: X = f(Y − b, Z) + a with
/// a, b the motion along machine X and Y.
inline double dx_dpart_x(const TermContext& at, std::size_t i) {
  return std::cos(at.c_rad[i]) + std::sin(at.c_rad[i]) * dx_dy(at, i);
}
inline double dx_dpart_y(const TermContext& at, std::size_t i) {
  return std::sin(at.c_rad[i]) - std::cos(at.c_rad[i]) * dx_dy(at, i);
}

inline double dx_d(Port port, const TermContext& at, std::size_t i) {
  switch (port) {
    case Port::normal:
      return dx_dform(at, i);
    case Port::c:
      return at.dx_dc[i];
    case Port::z:
      return at.dx_dz[i];
    case Port::x:
      break;
  }
  return 1.0;
}

/// Position that a term along Z is written in: s for what the part has, Z for the machine.
inline double along_mm(Port port, const TermContext& at, std::size_t i) {
  return port == Port::normal ? at.s_mm[i] : at.z_mm[i];
}
inline double normalised(Port port, const TermContext& at, std::size_t i) {
  return (along_mm(port, at, i) - at.z_mid_mm) / at.z_half_mm;
}

}  // namespace trueaxis::contact
