// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "calibrate/estimate/problem.hpp"

namespace trueaxis::calibrate_detail {

/// The rows of all files and their targets, unplaced. @throws InputError as `make_problem` does
Problem gather(const Machine& machine, std::span<const MachineMeasurement> data);

/// Where a target was met in one row, seen from the workpiece: at `point` (a bar: at `length_mm`
/// from it).
struct Sight {
  Eigen::Vector3d point;
  double along_mm = 0.0, length_mm = 0.0;
};

/// A ball's centre: the mean, or of a bar's lengths the point that has them (Eq. 173); of two that
/// lie mirrored about the plane of the tips the one towards +Z.
Eigen::Vector3d place_ball(std::span<const Sight> sights);

/// The point at s = 0 of the line through the balls; its direction goes to `target`.
Eigen::Vector3d place_line(std::span<const Sight> sights, Target& target);

}  // namespace trueaxis::calibrate_detail
