// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Rotary axes that keep the change they have while the others correct a position: the program does
/// not move them there.
struct HeldAxes {
  std::uint8_t set = 0;    ///< bit k: axis k is held
  AxisPositions change{};  ///< rad, of those that are held

  bool holds(std::size_t axis) const { return (set >> axis & 1U) != 0; }
  void hold(std::size_t axis, double change_rad) {
    set = static_cast<std::uint8_t>(set | 1U << axis);
    change[axis] = change_rad;
  }
};

}  // namespace trueaxis
