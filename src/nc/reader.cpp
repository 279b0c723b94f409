// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nc/arc.hpp"
#include "nc/block.hpp"
#include "nc/cycle_words.hpp"
#include "nc/program.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

constexpr std::size_t most_chords = 10'000'000;  // of a program: a gigabyte of moves

/// Takes the blocks of a program one by one, as a control does.
class Reader {
 public:
  Reader(Program& program, const ReadOptions& options, std::vector<Diagnostic>& wrong)
      : program_(program), options_(options), wrong_(wrong) {
    for (std::size_t k = 0; k < axis_count; ++k) {
      program_.start_words[k] = options.start[k].value_or(std::numeric_limits<double>::quiet_NaN());
      if (!options.start[k] || !has(options.axes, k)) continue;
      words_[k] = *options.start[k];
      known_ |= only(k);
    }
    unknown_since_ = "it has no word before this block and no [program] start";
  }

  void take(std::size_t index) {
    line_ = index;
    const Line& line = program_.lines[index];
    if (line.word_count == 0) return;
    ++program_.blocks;
    troubles_.clear();
    sort_words({program_.words.data() + line.first_word, line.word_count},
               {options_.axes, options_.arc_tolerance_mm.has_value(), state_.cycle}, block_,
               troubles_);
    for (const WordTrouble& trouble : troubles_) complain(*trouble.word, trouble.why);
    before_ = state_;
    take_program_number();
    change_tool();
    put_in_force();
    if (line.skip != 0 && sets_positions()) program_.skippable_states.push_back(line_);
    take_axes();
    if (block_.has_m(2) || block_.has_m(30) || block_.has_m(99)) end_program();
  }

 private:
  void complain(const Word& word, std::string why) {
    wrong_.push_back({program_.file, line_ + 1,
                      column_of(program_.text, program_.lines[line_], word.letter_at),
                      std::move(why)});
  }

  void forget(AxisSet axes, const std::string& since) {
    if ((known_ & axes) != 0) told_ = 0;
    known_ = static_cast<AxisSet>(known_ & ~axes);
    unknown_since_ = "not known since " + since + " in line " + std::to_string(line_ + 1);
  }

  void take_program_number() {
    if (block_.word('O') == nullptr || program_.moves.empty()) return;
    forget(all_axes, "the program that begins");
    continues_ = false;
  }

  /// The whole number of a word, or -1 and a complaint.
  int whole(const Word& word) {
    if (word.number >= 0.0 && word.number < 1e9 && word.number == std::floor(word.number))
      return static_cast<int>(word.number);
    complain(word, std::string(1, word.letter) + " has a whole number");
    return -1;
  }

  void change_tool() {
    if (const Word* tool = block_.word('T')) selected_ = whole(*tool);
    if (!block_.has_m(6)) return;
    const Line& line = program_.lines[line_];
    const Word* words = program_.words.data() + line.first_word;
    const Word* change = std::find_if(words, words + line.word_count, [](const Word& word) {
      return word.letter == 'M' && word.number == 6.0;
    });
    if (selected_ < 0) {
      if (block_.word('T') == nullptr) complain(*change, "M6 without T: say which tool");
      return;
    }
    if (selected_ > 0 && !options_.tools.empty() && !has_length(selected_))
      complain(*change, "tool " + std::to_string(selected_) +
                            " has no length in [tools] of the machine: add it there");
    if (selected_ != state_.tool) {  // many machines go to a position of their own for it
      forget(linear_axes, "the tool's change");
      continues_ = false;
    }
    state_.tool = selected_;
  }

  /// That a move at feed has a tool whose length is known.
  void check_tool(const Word& first) {
    if (state_.tool > 0 || options_.tools.empty() || has_length(0)) return;
    if (state_.motion == Motion::rapid && state_.cycle == 0) return;
    complain_once(first, told_tool_,
                  "no tool is in the spindle, and [tools] of the machine has the lengths: write "
                  "T and M6 before this block, or give tools.0.length_mm, or tool.length_mm");
  }

  /// Axes whose words move when the length in force changes.
  AxisSet length_axes() const {
    if (options_.mode == PositionMode::tip) return 0;
    if (before_.length == LengthOffset::tip || state_.length == LengthOffset::tip)
      return linear_axes;
    return only(options_.length_axis);
  }

  void put_in_force() {
    for (const int code : block_.g_tenths) apply_g(state_, code);
    if (const Word* feed = block_.word('F')) state_.feed = feed->number;
    if (state_.length != before_.length) forget(length_axes(), "the tool's length was switched");
    if (state_.work_offset != before_.work_offset) {
      shift_words(before_.work_offset);
      check_work_offset();
    } else if (block_.has_g(540 + 10 * state_.work_offset)) {
      check_work_offset();
    }
    if (before_.cycle == 0 && state_.cycle != 0) cycle_.begin(words_[2]);
    if (const Word* number = block_.word('H')) check_length_number(*number);
  }

  void shift_words(std::size_t from) {
    for (std::size_t k = 0; k < axis_count; ++k)
      words_[k] += options_.zeros[from][k] - options_.zeros[state_.work_offset][k];
    if (options_.mode == PositionMode::tip || state_.length == LengthOffset::tip)
      forget(linear_axes, "the work offset was changed");
  }

  void check_work_offset() {
    const bool in_cycle =
        before_.cycle != 0 && state_.cycle != 0 &&
        options_.zeros[before_.work_offset][2] != options_.zeros[state_.work_offset][2];
    if (options_.work_offsets[state_.work_offset] && !in_cycle) return;
    const int code = 54 + state_.work_offset;
    for (const Word& word : program_.words_of(program_.lines[line_]))
      if (word.letter == 'G' && word.number == code)
        complain(word,
                 "G" + std::to_string(code) +
                     (in_cycle ? " moves the zero of Z within a canned cycle: write G80 before it"
                               : " is not in [workpiece] of the machine"));
  }

  void check_length_number(const Word& word) {
    const int number = whole(word);
    if (number < 0) return;
    const bool on = state_.length != LengthOffset::none;
    if (number == 0) {
      if (on) complain(word, "H0 takes no length: write G49");
      return;
    }
    if (number == state_.tool || !has_length(number)) return;
    complain(word, "H" + std::to_string(number) + " is the length of a tool that is not in the " +
                       "spindle: put it in by T" + std::to_string(number) + " M6");
  }

  bool has_length(int tool) const {
    return std::ranges::find(options_.tools, tool) != options_.tools.end();
  }

  void take_axes() {
    const bool away_now = block_.has_g(g_home) || block_.has_g(g_second_home) ||
                          block_.has_g(g_machine) || block_.has_g(g_dwell);
    if (state_.cycle != 0 && !away_now && !block_.refused) return take_cycle();
    const bool circle =
        block_.named == 0 && is_arc(state_.motion) && block_.centre_word() != nullptr;
    if ((block_.named == 0 && !circle) || block_.has_g(g_dwell)) return check_dwell();
    const Word& first = circle ? *block_.centre_word() : block_.first_axis_word();
    const bool home = block_.has_g(g_home) || block_.has_g(g_second_home);
    const bool away = home || block_.has_g(g_machine);
    if (block_.refused) {
      // What it does is not known; its words are read, so that the blocks after it are read too.
    } else if (state_.incremental && !home) {
      complain_once(first, told_incremental_, "axis words under G91: write them under G90");
    } else if (state_.motion == Motion::none && !away) {
      complain_once(first, told_motion_, "axis words before G0 or G1: say how to move");
    } else if (!away) {
      return move(first);
    }
    take_words();
    if (away) leave();
  }

  void check_dwell() {
    if (block_.has_g(g_dwell)) {
      if ((block_.named & ~only(0)) != 0 || (block_.named != 0 && block_.word('P') != nullptr))
        complain(block_.first_axis_word(), "axis words with G4: give them a block of their own");
      return;
    }
    if (block_.has_g(g_home) || block_.has_g(g_second_home)) leave();
  }

  /// After G28, G30 and G53 the axes that they name, or all, and the tip are somewhere else.
  void leave() {
    const char* const by = block_.has_g(g_machine) ? "G53" : block_.has_g(g_home) ? "G28" : "G30";
    forget(block_.named != 0 ? block_.named : all_axes, by);
    if (options_.mode == PositionMode::tip || state_.length == LengthOffset::tip)
      forget(linear_axes, by);
    continues_ = false;
  }

  void move(const Word& first) {
    told_motion_ = told_incremental_ = false;
    const AxisSet before = known_;
    const AxisValues from = words_;
    take_words();
    const auto missing = static_cast<AxisSet>(options_.axes & ~known_);
    Move made{.line = static_cast<std::uint32_t>(line_),
              .named = block_.named,
              .words = words_,
              .modal = state_};
    if (missing != 0) {
      const bool carried_out = program_.lines[line_].skip == 0;
      if (state_.motion == Motion::rapid && carried_out && (missing & ~linear_axes) == 0) {
        program_.unknown_rapids.push_back(made);
        continues_ = false;
      } else if ((missing & ~told_) != 0) {
        complain(first, "the position of " + names_of(missing) + " is not known here (" +
                            unknown_since_ + "): give it in this block");
        told_ = missing;
      }
      return;
    }
    check_tool(first);
    made.decimals = decimals_;
    made.sets = sets_something();
    made.may_be_split =
        std::ranges::all_of(block_.m, [](int code) { return stops(code) || starts(code); });
    if (is_arc(state_.motion)) add_chords(first, made, from, before == options_.axes);
    made.words = words_;
    made.continues = continues_;
    program_.moves.push_back(made);
    continues_ = true;
  }

  /// A block of a canned cycle: the moves that it makes.
  void take_cycle() {
    if (!cycle_.take(block_, state_, program_.words)) return refuse_idle_cycle_words();
    const Word& first = block_.named != 0 ? block_.first_axis_word() : *block_.word('R');
    const auto missing = static_cast<AxisSet>(options_.axes & ~known_ & ~(block_.named & 0b011));
    std::string trouble = missing == 0
                              ? cycle_.trouble(block_, state_, words_, options_.axes)
                              : "the position of " + names_of(missing) + " is not known here (" +
                                    unknown_since_ + "): give it before the cycle";
    std::vector<CycleStep> steps;
    if (trouble.empty()) steps = steps_of(cycle_.cycle(block_, state_, words_), trouble);
    if (!trouble.empty()) return complain(first, trouble);
    check_tool(first);
    for (std::size_t k = 0; k < 3; ++k)
      if (has(block_.named, k)) decimals_[k] = block_.word(axis_letters[k])->decimals;
    known_ |= static_cast<AxisSet>(block_.named & 0b011);
    for (const CycleStep& step : steps) push_step(step);
  }

  /// They would be left without a cycle where its moves are written out.
  void refuse_idle_cycle_words() {
    for (const Word& word : program_.words_of(program_.lines[line_]))
      if (std::string_view("QPKL").find(word.letter) != std::string_view::npos ||
          (word.letter == 'G' && word.number > 80.0 && word.number < 84.0))
        complain(word,
                 "a word of a canned cycle without a hole: write it in the block of the hole");
  }

  void push_step(const CycleStep& step) {
    std::copy_n(step.at_mm, 3, words_.begin());
    Move made;
    made.line = static_cast<std::uint32_t>(line_);
    made.cycle = true;
    made.inserted = !program_.moves.empty() && program_.moves.back().line == line_;
    made.modal = state_;
    made.modal.motion = step.feed ? Motion::feed : Motion::rapid;
    made.decimals = decimals_;
    made.decimals[2] = std::max(decimals_[2], cycle_.decimals());
    if (step.bottom) made.dwell = cycle_.dwell();
    made.words = words_;
    made.named = static_cast<AxisSet>(block_.named & ~only(2));
    made.continues = continues_;
    program_.moves.push_back(made);
    continues_ = true;
    told_motion_ = told_incremental_ = false;
  }

  bool sets_something() const {
    ModalState before = before_, now = state_;
    if (is_arc(before.motion)) before.motion = Motion::feed;  // as it is written
    if (is_arc(now.motion)) now.motion = Motion::feed;
    const bool same_feed = before.feed == now.feed || block_.word('F') == nullptr;
    before.feed = now.feed = 0.0;
    return !same_feed || before != now || std::ranges::any_of(block_.m, starts) ||
           block_.word('S') != nullptr || block_.word('T') != nullptr ||
           block_.word('H') != nullptr;
  }

  /// That later positions are others without the block.
  bool sets_positions() const {
    ModalState before = before_, now = state_;
    before.motion = now.motion, before.feed = now.feed = 0.0;
    return before != now || block_.word('H') != nullptr;
  }

  /// The chords of an arc before its last, which is `made`.
  void add_chords(const Word& first, Move& made, const AxisValues& from, bool known) {
    if (!known) return complain(first, "an arc from a position that is not known");
    Arc arc{from, words_, state_.plane, state_.motion == Motion::arc_clockwise, {}, {}};
    const double factor = state_.inch ? mm_per_inch : 1.0;
    for (std::size_t k = 0; k < 3; ++k)
      if (const Word* word = block_.word("IJK"[k])) arc.centre_mm[k] = factor * word->number;
    if (const Word* radius = block_.word('R')) arc.radius_mm = factor * radius->number;
    std::string trouble;
    const std::optional<ArcWay> way = ArcWay::of(arc, *options_.arc_tolerance_mm, trouble);
    if (!way) return complain(first, trouble);
    chords_ += way->chords();
    if (chords_ > most_chords)
      return complain_once(first, told_chords_,
                           "the arcs up to here take more than 10000000 chords: raise their "
                           "tolerance, or cut the program in parts");
    made.arc = static_cast<std::uint32_t>(program_.arcs.size());
    program_.arcs.push_back(*way);
    made.inserted = true;
    for (; made.chord + 1 < way->chords(); ++made.chord) {
      made.words = way->after(made.chord + 1.0);
      made.continues = continues_;
      program_.moves.push_back(made);
      continues_ = true;
    }
    made.inserted = false;
  }

  void take_words() {
    for (std::size_t k = 0; k < axis_count; ++k) {
      if (!has(block_.named, k)) continue;
      const Word& word = *block_.word(axis_letters[k]);
      const double factor = is_rotary(k) ? rad_per_deg : state_.inch ? mm_per_inch : 1.0;
      words_[k] = factor * word.number;
      decimals_[k] = word.decimals;
    }
    known_ |= block_.named;
    told_ = static_cast<AxisSet>(told_ & ~block_.named);
  }

  void complain_once(const Word& word, bool& told, const char* why) {
    if (!std::exchange(told, true)) complain(word, why);
  }

  void end_program() {
    const bool inch = state_.inch;
    state_ = {};
    state_.inch = inch;
    forget(all_axes, "the end of the program");
    continues_ = false;
  }

  Program& program_;
  const ReadOptions& options_;
  std::vector<Diagnostic>& wrong_;
  Block block_;
  std::vector<WordTrouble> troubles_;
  std::size_t line_ = 0;
  ModalState state_, before_;  ///< in force, and before this block
  int selected_ = -1;
  AxisValues words_{};
  std::array<std::uint8_t, axis_count> decimals_{};
  CycleWords cycle_;
  AxisSet known_ = 0, told_ = 0;
  std::string unknown_since_;
  std::size_t chords_ = 0;
  bool continues_ = false, told_motion_ = false, told_incremental_ = false, told_chords_ = false,
       told_tool_ = false;
};

}  // namespace

Program read_program(std::string text, const std::string& file, const ReadOptions& options) {
  Program program;
  program.text = std::move(text);
  program.file = file;
  program.zeros = options.zeros;
  std::vector<Diagnostic> wrong;
  Lexed lexed = lex(program.text, file, wrong);
  program.lines = std::move(lexed.lines);
  program.words = std::move(lexed.words);
  Reader reader(program, options, wrong);
  for (std::size_t i = 0; i < program.lines.size(); ++i) reader.take(i);
  std::ranges::stable_sort(wrong, [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return program;
}

}  // namespace trueaxis::nc
