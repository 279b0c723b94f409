// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulate/machine/control.hpp"
#include "simulate/machine/measure.hpp"
#include "simulate/machine/tool_in_part.hpp"

namespace trueaxis::virtual_machine {

/// A program that the machine cuts, and the one that says what should be cut.
struct CutPlan {
  std::string program, program_file;  ///< text, and its name in diagnostics
  std::string nominal, nominal_file;
  std::optional<double> step_mm,
      step_rad;             ///< rows between the ends of G1 blocks; none: no such rows
  Disturbance disturbance;  ///< reversal and drift
};

/// Where the tool is in the part at the end of a block, or on the way to it.
struct CutRow {
  std::size_t line = 0;
  bool end = false;
  double time_s = 0.0;
  ToolInPart tool;
  /// Against what should be there; NaN where nothing says it: after G28, G30 and G53, on rapid
  /// moves but for their ends, and before the program has said where the machine is.
  double off_mm = 0.0;     ///< at an end the distance of the tips, between them that from the line
  double angle_rad = 0.0;  ///< at an end, between the directions
};

struct LargestOff {
  double value = 0.0;  ///< mm or rad
  std::size_t line = 0;
};

struct Cut {
  std::vector<CutRow> rows;
  std::size_t blocks = 0;       ///< that move
  std::size_t judged_ends = 0;  ///< blocks of the nominal program that were met
  LargestOff off_at_ends, angle_at_ends, off_between;
  double time_s = 0.0;
};

/// What the machine with these errors cuts. What should be cut is what the nominal machine makes of
/// the nominal program: at the ends of its blocks tip and direction, between those of a G1 block
/// the straight line from tip to tip. The program may have more moves than the
/// nominal one: pieces of its blocks.
/// @throws InputError with what the control cannot do; or if a program is not a form of the nominal
/// one
Cut cut(const Machine& machine, const ErrorModel& errors, const CutPlan& plan);

}  // namespace trueaxis::virtual_machine
