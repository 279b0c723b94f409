// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "nc/program.hpp"

namespace trueaxis::nc {

/// A position of the new program: that of a move, or one on the way to it (`inserted`), which
/// becomes a line of its own before the block of the move.
struct NewPosition {
  std::uint32_t move = 0;  ///< index in Program::moves
  bool inserted = false;
  AxisValues words{};  ///< mm, rad
};

inline constexpr std::size_t longest_line = 251;  ///< characters that LinuxCNC takes

struct WriteOptions {
  int linear_decimals = 4, angle_decimals = 5;  ///< or those of the source, where it has more
  AxisSet axes = all_axes;                      ///< that the machine has
};

/// A word as the new program has it.
struct NewNumber {
  double number = 0.0;  ///< in the program's unit
  double value = 0.0;   ///< mm, rad
  int decimals = 0;
  bool stays = false;  ///< it is that of the source: its text stays too
};

/// The number that axis `axis` of a position gets. Linear words under G20 get two decimals more, so
/// that they are no coarser than in mm.
NewNumber new_number(const Move& move, std::size_t axis, double value, const WriteOptions& options);

/// Whether the text of a word is this number already.
bool says(const Word& word, const NewNumber& number, const Move& move);

/// All words of a position as they will be written (mm, rad).
AxisValues as_written(const Move& move, const AxisValues& words, const WriteOptions& options);

struct Written {
  std::string text;
  std::size_t rewritten = 0, inserted = 0;  ///< blocks whose text changed; new lines
};

/// The program with new positions, in the order of the moves: each move of the program has one that
/// is not `inserted`, after those that are. All bytes stay except the numbers of axis words whose
/// value changed; an axis without a word whose output changed gets one after the last axis word.
/// Lines with the axis words of inserted positions come before their block. The first of them also
/// has the words that the block itself puts into force (G1, F, S, M3). Under G93 every F is
/// multiplied by the number of pieces. Arcs become G1. Canned cycles become G0 and G1 where a
/// position of any of them changes, the lines after the first come after the block. @throws
/// InputError where a line would have more than 251 characters, or a block cannot be cut
///         in pieces
Written write_program(const Program& program, std::span<const NewPosition> positions,
                      const WriteOptions& options);

}  // namespace trueaxis::nc
