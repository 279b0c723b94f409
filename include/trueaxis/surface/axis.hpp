// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace trueaxis {

/// A line nearly along the spindle: part frame, mm; passes (x, y, z_ref) with slopes dx/dz, dy/dz.
/// Direction cosines (Constantin et al. Eq. 1): l = slope_x n, m = slope_y n, n = 1/sqrt(1 +
/// slope²).
struct Axis {
  double x_mm = 0.0, y_mm = 0.0;        ///< where it pierces the plane z = z_ref
  double slope_x = 0.0, slope_y = 0.0;  ///< dx/dz and dy/dz, mm per mm
  double z_ref_mm = 0.0;

  std::array<double, 2> at(double z_mm) const {
    return {x_mm + slope_x * (z_mm - z_ref_mm), y_mm + slope_y * (z_mm - z_ref_mm)};
  }
};

/// An axis with the covariance of (x, y, slope_x, slope_y), row-major 4 × 4 (mm², mm, 1).
struct AxisEstimate {
  Axis axis;
  std::array<double, 16> covariance{};

  /// Standard uncertainty of the axis point at z in its worse direction, mm: the square root of the
  /// largest eigenvalue of the 2 × 2 covariance of (x(z), y(z)).
  double u_at(double z_mm) const;
};

}  // namespace trueaxis
