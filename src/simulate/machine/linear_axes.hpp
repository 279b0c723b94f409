// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "simulate/machine/bodies.hpp"

namespace trueaxis::virtual_machine {

/// Newton's method on differences for the linear axes of a machine, the rotary ones staying.
/// @param off_mm what is off of a point in space at given axes; it is to become nothing
/// @returns whether the linear axes span space; `axes` are left where the last step took them
template <class OffAt>
bool follow_with_linear_axes(const Machine& machine, const OffAt& off_mm, AxisPositions& axes) {
  constexpr double step_mm = 1.0, close_mm = 1e-12, flat = 1e-6;
  constexpr int most_steps = 20;
  std::vector<std::size_t> linear;
  for (const MachineAxis& axis : machine.axes)
    if (!is_rotary(axis.name)) linear.push_back(index_of(axis.name));
  const auto determinant = [](const std::array<Vector3, 3>& columns) {
    const auto& [a, b, c] = columns;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  for (int round = 0; round < most_steps; ++round) {
    const Vector3 off = off_mm(axes);
    if (std::hypot(off[0], off[1], off[2]) < close_mm) break;
    std::array<Vector3, 3> columns{};
    for (std::size_t k = 0; k < linear.size() && k < 3; ++k) {
      AxisPositions ahead = axes;
      ahead[linear[k]] += step_mm;
      const Vector3 there = off_mm(ahead);
      for (std::size_t i = 0; i < 3; ++i) columns[k][i] = off[i] - there[i];
    }
    const double whole = determinant(columns);
    if (linear.size() < 3 || !(std::abs(whole) > flat)) return false;
    for (std::size_t k = 0; k < 3; ++k) {  // Cramer's rule
      std::array<Vector3, 3> one = columns;
      one[k] = off;
      axes[linear[k]] += step_mm * determinant(one) / whole;
    }
  }
  return true;
}

}  // namespace trueaxis::virtual_machine
