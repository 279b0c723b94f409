// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

/// Factors between the units of the edge and those inside (mm, rad, s). Degrees, µm, inch and
/// diameter exist at the edge only: multiply on the way in, divide on the way out.
namespace trueaxis {

inline constexpr double two_pi = 2.0 * std::numbers::pi;
inline constexpr double rad_per_deg = std::numbers::pi / 180.0;
inline constexpr double mm_per_um = 1e-3;
inline constexpr double mm_per_inch = 25.4;
inline constexpr double mm_per_m = 1000.0;

/// A result: value, standard uncertainty u (GUM), unit; or, in `why_not`, why it is missing.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double u = std::numeric_limits<double>::quiet_NaN();  ///< standard uncertainty, k = 1
  std::string unit;     ///< of value and u, inside: "mm", "rad", "s", "1"
  std::string why_not;  ///< why value or u is missing; empty when both are there

  /// Ends of the probabilistically symmetric coverage interval (JCGM 101, 7.7), if value ± U does
  /// not contain it: the apex of a cone. It has the coverage factor of the estimate's result.
  std::optional<std::array<double, 2>> interval{};

  bool determined() const { return std::isfinite(value); }
  /// U: k u, or the larger side of an interval, so that value ± U holds it.
  double expanded(double coverage_factor) const {
    return interval ? std::max(value - interval->front(), interval->back() - value)
                    : coverage_factor * u;
  }
};

/// Of u in an upper bound that replaces value ± k u: 95 % confidence at least, whatever k is.
inline double bound_factor(double coverage_factor) { return std::max(coverage_factor, 2.0); }

/// From an angle inside to one at the edge, in degrees; 1 for any other unit.
inline double edge_factor(std::string_view unit) { return unit == "rad" ? 1.0 / rad_per_deg : 1.0; }

/// As files and screens have it: an angle in degrees, and what is per angle.
inline Estimate at_edge(Estimate inside) {
  const bool angle = inside.unit == "rad", per_angle = inside.unit == "mm/(rad)";
  if (!angle && !per_angle) return inside;
  const double factor = angle ? 1.0 / rad_per_deg : rad_per_deg;
  inside.value *= factor;
  inside.u *= factor;
  if (inside.interval)
    for (double& end : *inside.interval) end *= factor;
  inside.unit = angle ? "deg" : "mm/(deg)";
  return inside;
}

/// Decimals that show U with two digits (GUM 7.2.6), at least `least`; U of 0 or NaN shows `least`.
inline int decimals_of(double U, int least = 3) {
  if (!(U > 0.0)) return least;
  const int digits = 1 - static_cast<int>(std::floor(std::log10(U)));
  return digits < least ? least : digits > 12 ? 12 : digits;
}

}  // namespace trueaxis
