// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/number.hpp"
#include "trueaxis/control_table.hpp"
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

// One a format. What the control does with the numbers is that of its maker's manual, named there.

/// `C[deg]\Z[mm]` and a column for every position, then a row for every angle, µm.
MadeControlTable grid_csv(const Correction& correction, const ControlTable& table);
/// LinuxCNC halstreamer(1): blank-separated columns X_command in µm and C in degrees (cfg=ff), a
/// line a sample; lines with '#' are skipped. The last line is there twice, as halstreamer may hold
/// back the last of a multiple of its depth.
MadeControlTable halstreamer_text(const Correction& correction);
/// Blocks `C X Z`, C running, six decimals, one point a block under G93.
MadeControlTable servo_nc(const Correction& correction, const ControlTable& table);
/// SINUMERIK interpolatory compensation ($AN_CEC), a table of one turn for each band.
MadeControlTable sinumerik_cec(const Correction& correction, const ControlTable& table);
/// Beckhoff TwinCAT CNC and ISG plane compensation (kw.crosscomp2), integers of 0.1 µm.
MadeControlTable beckhoff_crosscomp2(const Correction& correction, const ControlTable& table);

}  // namespace trueaxis
