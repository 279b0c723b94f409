// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "form/exchange.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// A circle about points, given by angles and distances from a pole near its centre.
struct AssociatedCircle {
  double x_mm = 0.0, y_mm = 0.0, radius_mm = 0.0;  ///< centre against the pole
  std::vector<double> off_mm;                      ///< of each point, outwards
  std::vector<Nearest::Touch> touches;
  std::string why;  ///< why there is none; empty: there is
};

/// The circle of a profile. A pole with a radius: that in the plane, by associate(). Without one,
/// `radius_mm` = 0: the limaçon that a gauge's trace shows, Eq. 265. With
/// `shares` of the circumference, least squares are along it (ISO 12181-1) and about a pole so near
/// that the limaçon is the circle.
AssociatedCircle associate_circle(std::span<const double> angle_rad,
                                  std::span<const double> deviation_mm, double radius_mm,
                                  Criterion criterion, std::span<const double> shares = {});

/// The same of a limaçon that is so near to a pole with a radius (0: none) that it is the circle.
AssociatedCircle circle_near(std::vector<double> off_mm, const Nearest& nearest, double radius_mm);

/// All four criteria, or least squares and the minimum zone alone.
std::span<const Criterion> criteria_of(bool all_references);

/// 1, cos θ, sin θ of each angle: a row of Eq. 265.
Exchange::Rows limacon_rows(std::span<const double> angle_rad);

}  // namespace trueaxis::form
