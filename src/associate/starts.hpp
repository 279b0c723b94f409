// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "associate/placed.hpp"
#include "associate/point_cloud.hpp"

namespace trueaxis {

/// Where to begin, the most promising first. It uses principal axes if they are the answer.
/// Otherwise it uses the algebraic equation of the element, which is linear once the direction of
/// its axis is given, over directions spread evenly (Eq. 247).
std::vector<Placed> starts_of(Shape shape, const PointCloud& cloud, std::size_t most);

/// `count` directions of a half sphere, spread evenly (Fibonacci).
std::vector<Eigen::Vector3d> half_sphere(std::size_t count);

}  // namespace trueaxis
