// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/association.hpp"

namespace trueaxis {

/// Where a point is against an element, in the words of the result alone: none of the frames,
/// kernels and derivatives that found the element are used, so that they can be checked by it.
struct NearestSurface {
  double distance_mm = 0.0;
  Point3 normal{};  ///< unit vector away from the surface, in which the distance grows
  Point3 arm_mm{};  ///< from the point of the result to the point
};
NearestSurface nearest_surface(const AssociatedFeature& associated, const Point3& point);

/// The balance of a certificate: sums of λ s n, of λ s (arm × n), of what a larger size does. All
/// are 0 at the optimum of the motions that the element has (Eq. 253); for a constrained element
/// together with d / n of every point (Eq. 254).
struct Balance {
  Point3 force{}, moment_mm{};
  double size = 0.0;         ///< Σ λ s of a size that is free
  double second_size = 0.0;  ///< of a cone's angle (mm a rad), of a torus' major radius
};
Balance balance_of(const AssociatedFeature& associated, std::span<const Point3> points_mm);

}  // namespace trueaxis
