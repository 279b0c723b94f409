// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {

/// The same angle within the first turn: 0 to 2π.
inline double within_turn(double rad) { return rad - two_pi * std::floor(rad / two_pi); }

/// How far two angles are apart, whole turns aside: 0 to π.
inline double apart_rad(double a, double b) { return std::abs(std::remainder(a - b, two_pi)); }

/// Whether a number of degrees is one, two, three or four quarters of a turn in radians, rounded:
/// 1.57, 3.14, 4.71 or 6.28.
inline bool is_quarters_in_radians(double deg) {
  constexpr double rounded = 4e-3;
  const double size = std::abs(deg);
  return size > rounded && size < two_pi + rounded &&
         std::abs(std::remainder(size, 0.25 * two_pi)) < rounded;
}

/// Whether a range of degrees is a turn in radians, rounded: 6.28.
inline bool is_turn_in_radians(double deg) {
  return is_quarters_in_radians(deg) && deg > 1.9 * 0.5 * two_pi;
}

}  // namespace trueaxis
