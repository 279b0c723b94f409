// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "associate/placed.hpp"
#include "math/gram.hpp"

namespace trueaxis {

/// Distances of a block of points and their derivatives by the motions of the shape, of one
/// component: columns of the Jacobian, then the distance. After the last point all is 0.
struct DistanceBlock {
  alignas(64) double column[most_parameters + 1][block_size];
};

/// The distance of up to block_size points (Eq. 242) and its Jacobian at the place itself (Eq.
/// 243). For a line or circle in space that from its nearest point, never negative.
void evaluate_distances(const Placed& placed, std::span<const Point3> points, DistanceBlock& block);

/// The same by components, whose squares add up to that of the distance: two for a line or circle
/// in space (components[1] is not touched where the shape has one).
void evaluate_components(const Placed& placed, std::span<const Point3> points,
                         DistanceBlock components[2]);

/// Only the distances, of block_size points at most.
void evaluate_only_distances(const Placed& placed, std::span<const Point3> points,
                             double* distance_mm);

}  // namespace trueaxis
