// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nc/arc.hpp"
#include "nc/axes.hpp"
#include "nc/lexer.hpp"
#include "nc/modal.hpp"

namespace trueaxis::nc {

/// What the words X Y Z of a program are: positions of the axes, or of the tool's tip.
enum class PositionMode : std::uint8_t { axes, tip };

/// What a reader must know of the machine, which this room does not.
struct ReadOptions {
  AxisSet axes = all_axes;                 ///< that the machine has
  PositionMode mode = PositionMode::axes;  ///< while G43.4 is off
  std::size_t length_axis = 2;             ///< the linear axis along which G43 adds the length
  std::array<bool, 6> work_offsets{true, true, true, true, true, true};  ///< G54 … G59 are known
  std::array<AxisValues, 6> zeros{};  ///< of the work offsets: axis positions where words are 0
  std::vector<int> tools;             ///< whose lengths are known; empty: one for all
  /// Words in force before the first block (mm, rad); no value: not known.
  std::array<std::optional<double>, axis_count> start{};
  /// How far chords may be from an arc; not given: arcs are refused.
  std::optional<double> arc_tolerance_mm{};
};

/// A move to a position: a block with axis words under G0 or G1, a chord of an arc, or one of the
/// moves of a canned cycle.
struct Move {
  static constexpr std::uint32_t no_dwell = 0xFFFFFFFF, no_arc = 0xFFFFFFFF;
  std::uint32_t line = 0;  ///< index in Program::lines
  /// A chord that ends within its arc, or a move of a cycle after its first: it has no block yet.
  bool inserted = false;
  bool cycle = false;              ///< of a canned cycle; `modal` has G0 or G1
  std::uint32_t arc = no_arc;      ///< index in Program::arcs of the arc that it is a chord of
  std::uint32_t chord = 0;         ///< which one of it
  std::uint32_t dwell = no_dwell;  ///< index of the P of a dwell after it (G82) in Program::words
  bool continues = false;          ///< begins where the move before it in Program::moves ended
  /// Its block puts something into force (G1, F, S, M3) that a line before it would need.
  bool sets = false;
  bool may_be_split = true;  ///< no M code of its block would be carried out later or twice
  AxisSet named = 0;         ///< axes that have a word in the block
  AxisValues words{};        ///< in force at its end; 0 for an axis that the machine does not have
  std::array<std::uint8_t, axis_count> decimals{};  ///< of these words where they were written
  ModalState modal;                                 ///< with the words of its block in force
};

/// A program as it was read. Its text is kept byte by byte.
struct Program {
  std::string text, file;
  std::vector<Line> lines;
  std::vector<Word> words;
  std::vector<Move> moves;
  std::vector<ArcWay> arcs;
  std::array<AxisValues, 6> zeros{};  ///< ReadOptions::zeros
  AxisValues start_words{};           ///< ReadOptions::start; NaN where it is not known
  std::size_t blocks = 0;             ///< lines with a word
  /// Rapid moves with a linear axis whose position is not known: they stay as they are, and of
  /// their `words` those of `named` are known.
  std::vector<Move> unknown_rapids;
  /// Lines that begin with '/' and put something into force by which later positions are others.
  std::vector<std::size_t> skippable_states;

  std::span<const Word> words_of(const Line& line) const {
    return {words.data() + line.first_word, line.word_count};
  }
  std::size_t index_of(const Line& line) const {
    return static_cast<std::size_t>(&line - lines.data());
  }
  /// What ends a line, and the one before where it is the last of the text.
  std::string_view end_of(const Line& line) const {
    const std::size_t index = index_of(line);
    const std::size_t next = index + 1 < lines.size() ? lines[index + 1].begin : text.size();
    if (next > line.end) return std::string_view(text).substr(line.end, next - line.end);
    return index > 0 ? end_of(lines[index - 1]) : "\n";
  }
  std::string_view text_of(const Line& line) const {
    return std::string_view(text).substr(line.begin, line.end - line.begin);
  }
};

/// Reads a program of ISO 6983 words. Read are N G M F S T H O, axis words, comments, `/` and `%`;
/// G0 G1 G4 G17-G21 G28 G30 G40 G43 G43.4 G49 G53-G59 G61 G64 G80-G83 G90 G91 G93-G95 G98 G99, G2
/// and G3 with an arc tolerance. Canned cycles are moves along Z in G17. A position is known when
/// every axis of the machine has a word in force; none has after G28, G30, G53 and the end of a
/// program. X Y Z must be given again after M6 with another tool, and the axes that the tool's
/// length moves after G43, G43.4 and G49. Under G91 only G28 and G30 may have axis words, which are
/// left alone, and canned cycles. After another work offset the machine has not moved, so that the
/// words in force differ by the difference of the zeros; a tip must then be given again.
/// @throws InputError with everything that is not read, each with its line and column
Program read_program(std::string text, const std::string& file, const ReadOptions& options);

}  // namespace trueaxis::nc
