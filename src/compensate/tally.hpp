// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "trueaxis/compensation.hpp"

namespace trueaxis {

/// Takes a value in: the first of the largest stays.
inline void take(LargestInProgram& largest, double value, std::size_t line) {
  if (largest.line == 0 || std::abs(value) > largest.value) largest = {std::abs(value), line};
}
inline void take(LargestInProgram& largest, const LargestInProgram& later) {
  if (later.line != 0) take(largest, later.value, later.line);
}
inline double distance_mm(const Vector3& a, const Vector3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
inline void take(LargestToolError& largest, const ToolPose& pose, const ToolPose& target,
                 std::size_t line) {
  take(largest.position, distance_mm(pose.tip_mm, target.tip_mm), line);
  take(largest.direction, angle_between_rad(pose.direction, target.direction), line);
}
inline void take(LargestToolError& largest, const LargestToolError& later) {
  take(largest.position, later.position);
  take(largest.direction, later.direction);
}

/// What a run of moves adds to the result; runs are added up in the order of the program.
struct Tally {
  ProgramCompensation sums;
  std::vector<LargestInProgram> by_error;
  LargestInProgram u_tip;

  void add(const Tally& later);
};

}  // namespace trueaxis
