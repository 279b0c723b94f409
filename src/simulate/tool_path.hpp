// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// Where the nose centre is, against the turns of the spindle since the start of the programmed
/// cut. The word "depth" is the direction of the actuator (X, for a face Z), "position" that of the
/// feed.
class ToolPath {
 public:
  /// @throws InputError when table and program contradict each other.
  ToolPath(const CutProgram& program, const CutTable& table);

  double first_turn() const { return -lead_turns_; }
  double last_turn() const { return turns_ + lead_turns_; }
  double position_mm(double turn) const { return start_mm_ + feed_mm_ * turn; }
  double turn_at(double position_mm) const { return (position_mm - start_mm_) / feed_mm_; }
  /// Programmed depth of the nose centre plus the actuator's displacement.
  double depth_mm(double turn) const { return programmed_mm(turn) + displacement_mm(turn); }
  double displacement_mm(double turn) const;

 private:
  void check(const CutProgram& program, const CutTable& table) const;
  /// Whether a row is past the last turn of the cut and yet at its end.
  bool stands_at_end(const CutTable& table, std::size_t row) const;
  void load(const CutProgram& program, const CutTable& table);
  void program_line(const CutProgram& program);
  void run_actuator(const CutProgram& program);
  double table_mm(double turn) const;
  double continued_mm(double turn) const;
  double programmed_mm(double turn) const;

  double start_mm_ = 0.0, feed_mm_ = 0.0, turns_ = 0.0, lead_turns_ = 0.0;
  bool corrected_ = false, perfect_ = false;
  std::vector<double> row_turn_, row_mm_;  // the table
  std::vector<double> line_mm_;            // programmed depth, `line_per_turn` a turn
  std::vector<double> motion_mm_;          // displacement, `motion_per_turn` a turn
};

}  // namespace trueaxis::virtual_lathe
