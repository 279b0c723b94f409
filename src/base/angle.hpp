// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {

/// The same angle within the first turn: 0 to 2π.
inline double within_turn(double rad) { return rad - two_pi * std::floor(rad / two_pi); }

/// How far two angles are apart, whole turns aside: 0 to π.
inline double apart_rad(double a, double b) { return std::abs(std::remainder(a - b, two_pi)); }

}  // namespace trueaxis
