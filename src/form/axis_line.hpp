// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

namespace trueaxis::form {

/// A straight axis near Z: x = x0 + l z, y = y0 + m z.
struct AxisLine {
  double x0_mm = 0.0, y0_mm = 0.0, l = 0.0, m = 0.0;
  std::array<double, 2> at(double z_mm) const { return {x0_mm + l * z_mm, y0_mm + m * z_mm}; }
};

/// A centre of a section.
struct CentrePoint {
  double x_mm, y_mm, z_mm;
};

/// The line that the centres are nearest to by least squares; one centre: parallel to Z.
AxisLine least_squares_line(std::span<const CentrePoint> centres);

/// Diameter of the least cylinder along Z-ish axes that holds all centres: straightness of the
/// median line (ISO 12780, STRsa), by rows of Eq. 265 that are added until none is broken.
double smallest_cylinder_mm(std::span<const CentrePoint> centres);

/// The same of cylinders along the direction of `datum`: parallelism of an axis (ISO 1101).
double smallest_parallel_cylinder_mm(std::span<const CentrePoint> centres, const AxisLine& datum);

/// Twice the largest distance of a centre from a line, at right angles to it: coaxiality.
double coaxiality_mm(std::span<const CentrePoint> centres, const AxisLine& datum);

}  // namespace trueaxis::form
