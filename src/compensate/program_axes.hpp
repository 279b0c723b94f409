// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "nc/program.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Between the words of a program and the axes of a machine.
///
///     mode axes:  q = word + zero, + length on the linear axis along the tool while G43 is on
///     mode tip:   X Y Z are the tip in the program frame; of a rotary axis q = word + zero
///
/// G43.4 is mode tip.
class ProgramAxes {
 public:
  explicit ProgramAxes(const Machine& machine);

  nc::ReadOptions read_options(std::optional<double> arc_tolerance_mm) const;

  /// Program frame and tool length that are in force.
  Setting setting(const nc::ModalState& modal) const;
  ProgramMode mode(const nc::ModalState& modal) const;
  /// Whether G43 is on and no linear axis lies along the tool.
  bool length_without_axis(const nc::ModalState& modal) const;

  /// Axis positions that the control makes of words; nothing where the words are a tip and the
  /// linear axes do not span space.
  std::optional<AxisPositions> positions(const nc::AxisValues& words,
                                         const nc::ModalState& modal) const;
  /// Words that command `to`, given those that command `from`.
  nc::AxisValues words(const nc::AxisValues& words_from, const AxisPositions& from,
                       const AxisPositions& to, const nc::ModalState& modal) const;

  /// Where the rotary axes are by the words of a position; 0 of all others.
  AxisPositions rotary_positions(const nc::AxisValues& words, const nc::ModalState& modal) const;
  /// Where they are before the first move, which has `modal` in force: by [program] start of the
  /// machine, else at the word 0.
  AxisPositions rotary_start(const nc::Program& program, const nc::ModalState& modal) const;

  nc::AxisSet axes() const { return axes_; }

 private:
  const WorkOffset& offset(const nc::ModalState& modal) const;
  double length_mm(const nc::ModalState& modal) const;

  const Machine& machine_;
  MachineModel nominal_;
  std::array<WorkOffset, work_offset_count> offsets_;
  nc::AxisSet axes_ = 0;
  std::size_t length_axis_ = axis_count;  ///< axis_count: none lies along the tool
  double length_sign_ = 1.0;
};

}  // namespace trueaxis
