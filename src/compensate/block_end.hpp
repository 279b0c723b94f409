// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "compensate/program_axes.hpp"
#include "compensate/single_errors.hpp"
#include "compensate/tally.hpp"
#include "machine/held_axes.hpp"
#include "machine/uncertainty.hpp"
#include "nc/writer.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// How far from straight the component errors of each axis are.
struct ErrorBends {
  /// Over which they bend once, mm or rad: the distance of two points of a table, a quarter of a
  /// wave, the scale of a polynomial over its terms. Infinite: they do not.
  AxisPositions length;
  /// Points of tables, ascending; where a table repeats itself there is one everywhere.
  std::array<std::vector<double>, axis_count> corners;
  std::array<bool, axis_count> corner_everywhere{};
  /// The largest change of slope there, of the tip a metre from where it turns: mm per mm or rad.
  AxisPositions corner_mm;

  /// What the corners between two positions of an axis do to the tip compared with a straight way.
  double off_mm(std::size_t axis, double from, double to) const;
};

ErrorBends bends_of(const ErrorModel& errors);

/// What compensation needs of machine and program, shared by its steps and its threads.
struct CompensationTask {
  const MachineModel& model;
  const nc::Program& program;
  const CompensationOptions& options;
  ProgramAxes axes;
  nc::WriteOptions write;
  SingleErrors by_error;
  TipUncertainty uncertainty;
  ErrorBends bends;

  CompensationTask(const MachineModel& model_of, const nc::Program& program_of,
                   const CompensationOptions& options_of, const ProgramAxes& axes_of);
  std::size_t line_of(const nc::Move& move) const { return move.line + std::size_t{1}; }
};

/// The end of a move, in the program that was read and in the new one.
struct BlockEnd {
  AxisPositions commanded{};  ///< by the source
  AxisPositions written{};    ///< by the new program, with its decimals
  nc::AxisValues words{};     ///< of the new program, before they are rounded
  Vector3 tip_mm{};           ///< nominal, at `commanded`
  Vector3 actual_mm{};        ///< actual tip, at `commanded`
  Vector3 written_mm{};       ///< actual tip, at `written`
  double before_mm = 0.0;     ///< actual tip from the nominal one, at `commanded`
  double after_mm = 0.0;      ///< the same at `written`
  bool reached = false;
};

/// Compensates the position at which a move ends, but for axes that are held.
BlockEnd compensate_end(const CompensationTask& task, const nc::Move& move, const HeldAxes& held,
                        Tally& tally);

/// One position by the method that was asked for.
CompensatedPosition compensate_position(const CompensationTask& task, const AxisPositions& axes,
                                        const Setting& setting, const HeldAxes& held);

/// Whether the position can be commanded; if not, it is noted.
bool is_reached(const CompensatedPosition& position, std::size_t line, Tally& tally);

}  // namespace trueaxis
