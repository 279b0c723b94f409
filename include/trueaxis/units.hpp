// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

/// Factors between the units of the edge and those inside (mm, rad, s). Degrees, µm, inch and
/// diameter exist at the edge only: multiply on the way in, divide on the way out.
namespace trueaxis {

inline constexpr double two_pi = 2.0 * std::numbers::pi;
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;
inline constexpr double mm_per_um = 1e-3;
inline constexpr double mm_per_inch = 25.4;
inline constexpr double mm_per_m = 1000.0;

}  // namespace trueaxis
