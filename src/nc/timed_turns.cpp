// SPDX-License-Identifier: Apache-2.0
#include "nc/timed_turns.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "nc/number_text.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

/// How far the rotary axes turn in a move, degrees.
double turn_deg(const Program& program, std::size_t i) {
  double sum = 0.0;
  for (std::size_t k = 3; k < axis_count; ++k) {
    const auto at = [&](const Move& move) {
      return move.words[k] + program.zeros[move.modal.work_offset][k];
    };
    sum += std::pow((at(program.moves[i]) - at(program.moves[i - 1])) / rad_per_deg, 2);
  }
  return std::sqrt(sum);
}

/// F under G93, 1/min, of each line.
std::map<std::uint32_t, double> rates_of(const Program& program,
                                         std::span<const std::uint32_t> lines) {
  std::map<std::uint32_t, double> rates;
  std::vector<Diagnostic> wrong;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const Move& move = program.moves[i];
    if (!std::ranges::binary_search(lines, move.line)) continue;
    std::string why;
    if (!move.continues) why = "from a position that is not known";
    if (!(move.modal.feed > 0.0)) why = "without an F";
    if (move.modal.feed_mode == FeedMode::per_revolution) why = "under G95";
    if (why.empty())
      rates[move.line] = move.modal.feed / turn_deg(program, i);
    else
      wrong.push_back({program.file, move.line + std::size_t{1}, 1,
                       "turns rotary axes alone " + why +
                           ": the correction moves X Y Z too, and the time of the turn would be "
                           "another. Write it under G93"});
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return rates;
}

class TimedTurns {
 public:
  TimedTurns(const Program& program, std::span<const std::uint32_t> lines)
      : program_(program), rates_(rates_of(program, lines)) {}

  std::string write() {
    for (std::size_t i = 0; i < program_.lines.size(); ++i) {
      const Line& line = program_.lines[i];
      if (std::ranges::all_of(program_.words_of(line), is_number)) continue;
      const auto turn = rates_.find(static_cast<std::uint32_t>(i));
      if (turn != rates_.end())
        turn_in(line, turn->second);
      else if (timed_)
        feed_again(line);
      else
        remember(line);
    }
    out_.append(program_.text, copied_);
    return std::move(out_);
  }

 private:
  std::string text_of(const Word& word) const {
    return program_.text.substr(word.letter_at, word.end - word.letter_at);
  }
  /// Of a block or a program: a line of nothing else puts nothing into force.
  static bool is_number(const Word& word) { return word.letter == 'N' || word.letter == 'O'; }
  const Word* feed_of(const Line& line) const {
    const auto word = std::ranges::find(program_.words_of(line), 'F', &Word::letter);
    return word == program_.words_of(line).end() ? nullptr : &*word;
  }
  const Word* feed_mode_of(const Line& line) const {
    const auto word = std::ranges::find_if(program_.words_of(line), [](const Word& one) {
      return one.letter == 'G' && one.number >= 93.0 && one.number <= 95.0;
    });
    return word == program_.words_of(line).end() ? nullptr : &*word;
  }

  void remember(const Line& line) {
    if (const Word* const feed = feed_of(line)) feed_ = text_of(*feed);
  }
  void copy_to(std::size_t end) {
    out_.append(program_.text, copied_, end - copied_);
    copied_ = end;
  }
  void replace(const Word& word, const std::string& text) {
    copy_to(word.letter_at);
    out_ += text;
    copied_ = word.end;
  }
  /// Before the first word of the line but its number and that of a program.
  void insert(const Line& line, const std::string& text) {
    const std::span<const Word> words = program_.words_of(line);
    const Word& first = is_number(words.front()) ? words[1] : words.front();
    copy_to(first.letter_at);
    out_ += text;
    if (line.has_blanks) out_ += ' ';
  }

  void turn_in(const Line& line, double rate) {
    remember(line);
    std::string feed = "F";
    append_number(feed, rate, decimals_of(rate));
    if (feed_mode_of(line) == nullptr && !timed_) insert(line, "G93");
    for (const Word& word : program_.words_of(line)) {
      if (&word == feed_mode_of(line)) replace(word, "G93");
      if (&word == feed_of(line)) replace(word, feed);
    }
    if (feed_of(line) == nullptr) {
      copy_to(program_.words_of(line).back().end);
      out_ += line.has_blanks ? " " + feed : feed;
    }
    timed_ = true;
  }

  /// Six digits count.
  static int decimals_of(double rate) {
    return std::clamp(5 - static_cast<int>(std::floor(std::log10(rate))), 1, 9);
  }

  void feed_again(const Line& line) {
    const Word* const mode = feed_mode_of(line);
    if (mode == nullptr) insert(line, "G94");
    if (feed_of(line) == nullptr && (mode == nullptr || mode->number == 94.0)) insert(line, feed_);
    remember(line);
    timed_ = line.skip != 0;  // what the control may skip does not count
  }

  const Program& program_;
  std::map<std::uint32_t, double> rates_;
  std::string out_, feed_;
  std::size_t copied_ = 0;
  bool timed_ = false;
};

}  // namespace

std::string with_timed_turns(const Program& program, std::span<const std::uint32_t> lines) {
  return TimedTurns(program, lines).write();
}

}  // namespace trueaxis::nc
