// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

namespace trueaxis {

/// How far readings that lie off together do so sideways, as if the part had moved there: the
/// amplitude of off = a + b Z + x cos C + y sin C (least squares).
struct Sideways {
  double size_mm = 0.0;
  double u_mm = 0.0;  ///< of x or y, the larger; infinite: their angles do not show it

  /// Whether another diameter or taper explains what is off: no movement beyond `within_mm` shows,
  /// and one of `least_mm` would have.
  bool stays(double within_mm, double least_mm) const {
    return size_mm <= std::max(3.0 * u_mm, within_mm) && 3.0 * u_mm <= least_mm;
  }
};

/// @param c_rad, z_mm, off_mm a value a reading
Sideways sideways_of(std::span<const double> c_rad, std::span<const double> z_mm,
                     std::span<const double> off_mm);

}  // namespace trueaxis
