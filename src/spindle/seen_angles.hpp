// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

namespace trueaxis {

/// The angle of a sensor from the first one, as the motion that does not repeat shows it.
struct SeenAngle {
  double from_first_rad = 0.0, u_rad = 0.0;
};

/// Three sensors or more see a motion of two directions: one combination of them reads none if the
/// angles are right, and a share of the motion if they are not. Form and what repeats have no
/// part in it. A gain does the same as an angle. @param asynchronous_mm readings by sensors
/// @param free_share of the readings' freedom, that what repeats has not used
/// @param u_largest_rad of the angles, from which on they do not show
/// @returns one for each sensor; empty: it does not show them
std::vector<SeenAngle> seen_angles(std::span<const double> stated_rad,
                                   const Eigen::MatrixXd& asynchronous_mm, double free_share,
                                   double u_largest_rad);

}  // namespace trueaxis
