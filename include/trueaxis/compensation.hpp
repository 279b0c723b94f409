// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "trueaxis/machine.hpp"
#include "trueaxis/reason.hpp"

/// A program of a control rewritten so that a machine with errors moves the tool where a machine
/// without would (docs/reference/nc.md).
namespace trueaxis {

enum class CompensationMethod {
  exact,        ///< compensate_exactly
  differential  ///< compensate_by_differential
};

/// Rotary axes that a compensation may turn.
enum class RotaryUse {
  moved,  ///< in a block those that the block moves: what a program leaves standing stands still
  all     ///< all of them in every block
};

struct CompensationOptions {
  CompensationMethod method = CompensationMethod::exact;
  RotaryUse rotary = RotaryUse::moved;
  /// How far the actual tip may be from the line between the nominal ends of a G1 block, or from an
  /// arc. Blocks and chords are cut in pieces for it; not given: they stay whole.
  std::optional<double> tolerance_mm{};
  /// How far the chords that G2 and G3 are replaced by may be from the arc; not given: refused.
  std::optional<double> arc_tolerance_mm{};
  int decimals = 4, angle_decimals = 5;  ///< of changed words, where the source has not more
  int threads = 0;                       ///< 0: as many as there are; the result is the same
  double coverage_factor = 2.0;          ///< k of the U that is reported
  bool keep_ends = false;                ///< ProgramCompensation::ends are wanted
  /// @throws ContractViolation
  void validate() const;
};

/// The largest of something in a program, and the line of its block (1-based; 0: there is none).
struct LargestInProgram {
  double value = 0.0;  ///< mm or rad
  std::size_t line = 0;
};

/// For tip and direction, against those of the program as it was read, on a machine without errors.
struct LargestToolError {
  LargestInProgram position, direction;
};

struct SingularBlock {
  std::size_t line = 0;
  double direction_left_rad = 0.0;
};

struct UnreachableBlock {
  std::size_t line = 0;
  std::string why;
};

/// What one error alone does to the tip.
struct ErrorAlone {
  std::string name;
  LargestInProgram tip;
};

/// Where a move ends: in the program as it was read, and as it was written.
struct ProgramEnd {
  std::size_t line = 0;    ///< 1-based, of the program that was read
  bool rapid = false;      ///< G0: no cut
  bool continues = false;  ///< begins where the move before it ends
  bool along_tip = false;  ///< between its ends the tip and the rotary axes go evenly, not all axes
  AxisPositions commanded{}, written{};
  std::optional<AxisPositions> middle;  ///< commanded half way, of a chord of an arc: on the arc
  Setting setting;
};

struct ProgramCompensation {
  std::string text;  ///< the new program; of one with unreachable blocks empty
  std::size_t blocks_read = 0, blocks_moved = 0, blocks_rewritten = 0, blocks_inserted = 0;
  std::array<LargestInProgram, axis_count> largest_change{};  ///< of the words of an axis
  LargestToolError before, after;                             ///< at the ends of blocks, as written
  /// Of the actual tip from the line between the nominal ends of G1 blocks; or from the way of the
  /// nominal machine on an arc, and where axes turn far or alone (Eq. 331).
  LargestInProgram between_before, between_after;
  LargestInProgram about_tool_axis;  ///< left about the tool's own axis
  std::array<LargestInProgram, axis_count> exact_minus_differential{};
  LargestToolError rounding;  ///< what the decimals cost
  /// Lines of blocks that come out worse than they went in, by a hundredth and 0.1 µm.
  std::vector<std::size_t> worse;
  std::vector<SingularBlock> singular;
  std::vector<UnreachableBlock> unreachable;
  std::vector<ErrorAlone> by_error;       ///< the largest first
  std::optional<LargestInProgram> u_tip;  ///< standard uncertainty, where the errors have u
  std::vector<std::string> remarks;       ///< what it assumes of the control
  Reasons reservations;                   ///< what the largest deviations do not count or tell
  std::vector<ProgramEnd> ends;           ///< of every move that is reached, where they are wanted

  /// The largest deviation of the actual tip on the whole path, ends of blocks and between them,
  /// for the program as it was read and as it is written.
  LargestInProgram off_before() const, off_after() const;
  /// Whether a block or the whole path is further off than it was: such a program is not an
  /// improvement and must not replace the old one.
  bool comes_out_worse() const;
  /// Whether the largest error of direction is larger than it was, by more than its rounding.
  bool direction_comes_out_worse() const;
};

/// Reads the program `text` (called `file` in diagnostics) and compensates every position.
/// @throws InputError with all that is refused in it, each with its line and column
ProgramCompensation compensate_program(const MachineModel& model, std::string text,
                                       const std::string& file, const CompensationOptions& options);

}  // namespace trueaxis
