// SPDX-License-Identifier: Apache-2.0
#include "nc/writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nc/block_skip.hpp"
#include "nc/number_text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::nc {
namespace {

bool is_one_of(char letter, std::string_view letters) {
  return letters.find(letter) != std::string_view::npos;
}

class Writer {
 public:
  Writer(const Program& program, const WriteOptions& options)
      : program_(program),
        options_(options),
        source_(program.text),
        in_force_(program.start_words),
        skip_(program) {
    out_.text.reserve(source_.size() + source_.size() / 2);
  }

  Written write(std::span<const NewPosition> positions) {
    std::size_t next = 0;
    auto stays = program_.unknown_rapids.begin();
    cycles_change_ = std::ranges::any_of(positions, [&](const NewPosition& one) {
      return program_.moves[one.move].cycle && changes(one);
    });
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      const Line& line = program_.lines[i];
      copy_to(line.begin);
      const std::size_t first = next;
      while (next < positions.size() && program_.moves[positions[next].move].line == i) ++next;
      const auto moves = positions.subspan(first, next - first);
      if (!moves.empty())
        program_.moves[moves.front().move].cycle ? write_cycle(line, moves)
                                                 : write_block(line, moves);
      if (stays != program_.unknown_rapids.end() && stays->line == i) leave_block(*stays++);
      skip_.pass(i);
    }
    copy_to(source_.size());
    if (!wrong_.empty()) throw InputError(std::move(wrong_));
    return std::move(out_);
  }

 private:
  void copy_to(std::size_t end) {
    out_.text.append(source_, copied_, end - copied_);
    copied_ = end;
  }

  /// A block that stays as it is takes its axes to the words of the old program.
  void leave_block(const Move& move) {
    change_work_offset(move.modal.work_offset);
    for (std::size_t k = 0; k < axis_count; ++k)
      if (has(move.named, k)) in_force_[k] = move.words[k];
  }

  bool changes(const NewPosition& position) const {
    const Move& move = program_.moves[position.move];
    for (std::size_t k = 0; k < axis_count; ++k)
      if (has(options_.axes, k) && !new_number(move, k, position.words[k], options_).stays)
        return true;
    return false;
  }

  /// The moves of a canned cycle as G0 and G1: the block itself becomes the first of them. If no
  /// cycle of the program changes, all stay.
  void write_cycle(const Line& line, std::span<const NewPosition> positions) {
    const Move& move = program_.moves[positions.front().move];
    change_work_offset(move.modal.work_offset);
    if (!cycles_change_) {
      in_force_ = program_.moves[positions.back().move].words;
      return;
    }
    const std::size_t begin = out_.text.size();
    rewrite_cycle(line, positions.front());
    copy_to(line.end);
    check_length(line, out_.text.size() - begin);
    ++out_.rewritten;
    rapid_ = true;
    for (std::size_t i = 1; i < positions.size(); ++i) {
      const Move& step = program_.moves[positions[i].move];
      write_step(line, step, positions[i]);
      const bool ends = i + 1 == positions.size() || positions[i + 1].move != positions[i].move;
      if (step.dwell == Move::no_dwell || !ends) continue;
      const Word& dwell = program_.words[step.dwell];
      begin_step(line);
      out_.text += line.has_blanks ? "G4 " : "G4";
      out_.text += source_.substr(dwell.letter_at, dwell.end - dwell.letter_at);
      ++out_.inserted;
    }
    if (!move.modal.incremental) return;
    begin_step(line);
    out_.text += "G91";
    ++out_.inserted;
  }

  void begin_step(const Line& line) {
    out_.text += program_.end_of(line);
    out_.text += line.skip_text();
    words_ = 0;
  }

  void write_step(const Line& line, const Move& step, const NewPosition& position) {
    const std::size_t before = out_.text.size();
    begin_step(line);
    const std::size_t begin = out_.text.size();
    const bool rapid = step.modal.motion == Motion::rapid;
    if (rapid != rapid_) {
      separate(line);
      out_.text += rapid ? "G0" : "G1";
    }
    const int without_axes = words_;
    add_axes(line, step, position);
    if (words_ == without_axes) return out_.text.resize(before);  // it is where the one before is
    rapid_ = rapid;
    check_length(line, out_.text.size() - begin);
    ++out_.inserted;
  }

  /// The block as G0 above its first hole, under G90 and without what only the cycle needs.
  void rewrite_cycle(const Line& line, const NewPosition& position) {
    const Move& move = program_.moves[position.move];
    bool absolute = !move.modal.incremental;
    const auto say_absolute = [&] {
      if (!std::exchange(absolute, true)) out_.text += line.has_blanks ? "G90 " : "G90";
    };
    const std::size_t begin = out_.text.size();
    const Word* last = nullptr;  // after which other axes come
    for (const Word& word : program_.words_of(line))
      if (axis_of(word.letter) < axis_count && word.letter != 'Z') last = &word;
    for (const Word& word : program_.words_of(line)) {
      const std::size_t axis = axis_of(word.letter);
      const bool cycle = word.letter == 'G' && word.number >= 81.0 && word.number <= 83.0;
      if (is_one_of(word.letter, "ZRQPKL") ||
          (word.letter == 'G' && (word.number >= 98.0 || word.number == 91.0))) {
        drop(word);
        if (out_.text.size() == begin)
          while (copied_ < line.end && is_blank(source_[copied_])) ++copied_;
        continue;
      }
      if (cycle || (axis < axis_count && has(move.named, axis))) {
        copy_to(word.letter_at);
        say_absolute();
      }
      if (cycle) {
        out_.text += source_[word.letter_at];
        out_.text += '0';
        copied_ = word.end;
      } else if (axis < axis_count && has(move.named, axis)) {
        NewNumber now = new_number(move, axis, position.words[axis], options_);
        // A distance under G91, and the hole where the first move is up to R.
        now.stays = now.stays && !move.modal.incremental && says(word, now, move);
        if (move.modal.incremental) check_sure(line, axis);
        replace_number(word, now, axis);
      } else {
        copy_to(word.end);
      }
      if (&word == last) add_words(line, move, position);
    }
    if (!absolute) {
      if (line.has_blanks && out_.text.size() > begin) out_.text += ' ';
      out_.text += "G90";
    }
    if (last == nullptr) add_words(line, move, position);
  }

  void write_block(const Line& line, std::span<const NewPosition> positions) {
    pieces_ = static_cast<double>(positions.size());
    const Move& move = program_.moves[positions.back().move];
    change_work_offset(move.modal.work_offset);
    if (positions.size() > 1 && !move.may_be_split)
      complain(line,
               "is to be cut in pieces and has an M code of which controls do not agree when it "
               "acts, or that may act once only: give it a block of its own");
    if (positions.size() > 1 && move.modal.feed_mode == FeedMode::inverse_time && !has_feed(line))
      complain(line, "is to be cut in pieces and has no F, which G93 asks for in every block");
    for (std::size_t k = 0; k + 1 < positions.size(); ++k) write_piece(line, positions[k], k == 0);
    const std::size_t begin = out_.text.size();
    rewrite(line, positions.back());
    copy_to(line.end);
    const std::string_view now = std::string_view(out_.text).substr(begin);
    if (now == program_.text_of(line)) return;
    ++out_.rewritten;
    check_length(line, now.size());
  }

  /// The machine has not moved, but other words say where it is.
  void change_work_offset(std::size_t to) {
    for (std::size_t k = 0; k < axis_count; ++k)
      in_force_[k] += program_.zeros[work_offset_][k] - program_.zeros[to][k];
    work_offset_ = to;
  }

  /// A line for a position on the way of a block.
  void write_piece(const Line& line, const NewPosition& position, bool first) {
    const Move& move = program_.moves[position.move];
    const std::size_t begin = out_.text.size();
    out_.text += line.skip_text();
    words_ = 0;
    if (first && move.sets) repeat_words(line, move);
    add_axes(line, move, position);
    if (move.modal.feed_mode == FeedMode::inverse_time) append_feed_word(line);
    if (words_ == 0) return out_.text.resize(begin);  // it is where the one before is
    check_length(line, out_.text.size() - begin);
    out_.text += program_.end_of(line);
    ++out_.inserted;
  }

  /// Words that the block puts into force and that its pieces need before it.
  void repeat_words(const Line& line, const Move& move) {
    const bool has_p = std::ranges::any_of(program_.words_of(line), [](const Word& word) {
      return word.letter == 'M' || (word.letter == 'G' && word.number == 64.0);
    });
    for (const Word& word : program_.words_of(line)) {
      if (is_one_of(word.letter, has_p ? "NOXYZABCIJKR" : "NOXYZABCIJKPQR")) continue;
      if (word.letter == 'F' && move.modal.feed_mode == FeedMode::inverse_time) continue;
      if (word.letter == 'M' && stops(static_cast<int>(word.number))) continue;
      separate(line);
      append_word(word, move);
    }
  }

  bool has_feed(const Line& line) const {
    return std::ranges::find(program_.words_of(line), 'F', &Word::letter) !=
           program_.words_of(line).end();
  }

  void append_feed_word(const Line& line) {
    for (const Word& word : program_.words_of(line)) {
      if (word.letter != 'F') continue;
      separate(line);
      out_.text += source_[word.letter_at];
      append_feed(word);
    }
  }

  void separate(const Line& line) {
    if (words_++ > 0 && line.has_blanks) out_.text += ' ';
  }

  /// A word as it is; that of an arc as G1.
  void append_word(const Word& word, const Move& move) {
    std::string text(source_.substr(word.letter_at, word.end - word.letter_at));
    if (word.letter == 'G' && is_arc(move.modal.motion) &&
        (word.number == 2.0 || word.number == 3.0))
      text[text.find_first_of("23")] = '1';
    out_.text += text;
  }

  void append_feed(const Word& word) {
    const int decimals = word.decimals;
    append_number(out_.text, rounded(word.number * pieces_, decimals), decimals);
    if (decimals == 0 && source_[word.end - 1] == '.') out_.text += '.';
  }

  void append(char letter, const NewNumber& now) {
    out_.text += letter;
    append_number(out_.text, now.number, now.decimals);
  }

  bool is_new(std::size_t axis, const NewNumber& now) const {
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(now.value);
    return !(std::abs(now.value - in_force_[axis]) <= rounding);
  }

  /// The block itself, up to its last word that may change.
  void rewrite(const Line& line, const NewPosition& position) {
    const Move& move = program_.moves[position.move];
    const bool arc = is_arc(move.modal.motion);
    const Word* last = last_axis_word(line);
    for (const Word& word : program_.words_of(line)) {
      const std::size_t axis = axis_of(word.letter);
      if (axis < axis_count && has(move.named, axis)) {
        replace_number(word, new_number(move, axis, position.words[axis], options_), axis);
      } else if (word.letter == 'F' && pieces_ > 1.0 &&
                 move.modal.feed_mode == FeedMode::inverse_time) {
        copy_to(word.number_begin);
        append_feed(word);
        copied_ = word.end;
      } else if (arc && is_one_of(word.letter, "IJKR")) {
        drop(word);
      } else if (arc && word.letter == 'G') {
        copy_to(word.letter_at);
        append_word(word, move);
        copied_ = word.end;
      }
      if (&word == last) add_words(line, move, position);
    }
  }

  void replace_number(const Word& word, const NewNumber& now, std::size_t axis) {
    in_force_[axis] = now.value;
    if (now.stays) return copy_to(word.end);
    copy_to(word.number_begin);
    if (source_[word.number_begin] == '+' && now.number >= 0.0) out_.text += '+';
    append_number(out_.text, now.number, now.decimals);
    copied_ = word.end;
  }

  /// Leaves a word out, and the blanks before it.
  void drop(const Word& word) {
    copy_to(word.letter_at);
    while (!out_.text.empty() && (out_.text.back() == ' ' || out_.text.back() == '\t'))
      out_.text.pop_back();
    copied_ = word.end;
  }

  /// Words of the axes whose output changed.
  void add_axes(const Line& line, const Move& step, const NewPosition& position) {
    for (std::size_t k = 0; k < axis_count; ++k) {
      if (!has(options_.axes, k)) continue;
      const NewNumber now = new_number(step, k, position.words[k], options_);
      if (!is_new(k, now)) continue;
      if (!step.cycle || !has(step.named, k)) check_sure(line, k);
      separate(line);
      append(axis_letters[k], now);
      in_force_[k] = now.value;
    }
  }

  /// Words of axes that the block does not name and whose output changed.
  void add_words(const Line& line, const Move& move, const NewPosition& position) {
    for (std::size_t k = 0; k < axis_count; ++k) {
      if (has(move.named, k) || !has(options_.axes, k)) continue;
      const NewNumber now = new_number(move, k, position.words[k], options_);
      if (!is_new(k, now)) continue;
      check_sure(line, k);
      if (line.has_blanks) out_.text += ' ';
      append(axis_letters[k], now);
      in_force_[k] = now.value;
    }
  }

  /// The last axis word, or for a circle without one, the last word that stays.
  const Word* last_axis_word(const Line& line) const {
    const Word *last = nullptr, *other = nullptr;
    for (const Word& word : program_.words_of(line)) {
      if (axis_of(word.letter) < axis_count) last = &word;
      if (is_one_of(word.letter, "NG")) other = &word;
    }
    return last != nullptr ? last : other;
  }

  /// A new word of an axis that a block moves which the control may skip would move it there.
  void check_sure(const Line& line, std::size_t axis) {
    if (std::string why = skip_.trouble(program_.index_of(line), axis); !why.empty())
      complain(line, std::move(why));
  }

  void check_length(const Line& line, std::size_t length) {
    if (length > longest_line)
      complain(line,
               "would have " + std::to_string(length) +
                   " characters, and LinuxCNC takes 251: shorten it or ask for fewer decimals");
  }
  void complain(const Line& line, std::string why) {
    wrong_.push_back({program_.file, program_.index_of(line) + 1, 1, std::move(why)});
  }

  const Program& program_;
  const WriteOptions& options_;
  std::string_view source_;
  AxisValues in_force_;  ///< words of the new program
  Written out_;
  std::vector<Diagnostic> wrong_;
  std::size_t copied_ = 0, work_offset_ = 0;
  double pieces_ = 1.0;
  int words_ = 0;               ///< of the line that is made
  bool cycles_change_ = false;  ///< canned cycles are written as G0 and G1
  BlockSkip skip_;
  bool rapid_ = true;  ///< of a cycle that is written, the motion in force
};

}  // namespace

Written write_program(const Program& program, std::span<const NewPosition> positions,
                      const WriteOptions& options) {
  return Writer(program, options).write(positions);
}

}  // namespace trueaxis::nc
