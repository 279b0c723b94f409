// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// The wanted correction on a grid over one turn of C and the length of the cut, both ends
/// included, mm.
struct CorrectionGrid {
  std::vector<double> position_mm;  ///< rising, evenly spaced
  std::size_t angles = 0;           ///< nodes of a turn, 0 and 360° both
  std::vector<double> value_mm;     ///< [position][angle]

  double& at(std::size_t position, std::size_t angle) {
    return value_mm[position * angles + angle];
  }
  double at(std::size_t position, std::size_t angle) const {
    return value_mm[position * angles + angle];
  }
  /// Bilinear between the nodes, as controls read such a table; end values held along the position.
  double between(double c_rad, double at_position_mm) const;
};

/// How many nodes a grid has: over a turn, and over the length with this step.
std::size_t nodes_of_turn(double c_step_rad);
std::size_t nodes_of_length(double length_mm, double step_mm);

/// @param c_step_rad a whole number of them is a turn
CorrectionGrid correction_grid(const Correction& correction, double c_step_rad, double step_mm);

}  // namespace trueaxis
