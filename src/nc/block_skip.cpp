// SPDX-License-Identifier: Apache-2.0
#include "nc/block_skip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trueaxis::nc {
namespace {

constexpr std::size_t no_switch = 10;
constexpr double same = 1e-9;  // mm, rad

std::size_t switch_of(const Line& line) {
  if (line.skip == 0) return no_switch;
  return line.skip == '/' ? 1 : static_cast<std::size_t>(line.skip - '0');
}

}  // namespace

BlockSkip::BlockSkip(const Program& program) : program_(program), words_(program.start_words) {
  for (Skipped& one : switches_) one.words = words_;
  any_ = std::ranges::any_of(program.lines, [](const Line& line) { return line.skip != 0; });
}

/// Number of the line (from 1) that moves the axis if it is not skipped; 0: none.
std::size_t BlockSkip::skipped_before(std::size_t line, std::size_t axis) const {
  for (std::size_t digit = 0; any_ && digit < switches_.size(); ++digit) {
    const Skipped& one = switches_[digit];
    if (digit != switch_of(program_.lines[line]) &&
        !(std::abs(one.words[axis] - words_[axis]) <= same) && !std::isnan(words_[axis]))
      return one.by[axis] + std::size_t{1};
  }
  return 0;
}

std::string BlockSkip::trouble(std::size_t line, std::size_t axis) {
  const std::size_t by = skipped_before(line, axis);
  if (by == 0 || std::exchange(told_[axis], by) == by) return "";
  const std::string letter(1, axis_letters[axis]), number = std::to_string(by);
  return "needs a new word " + letter + ", but " + letter +
         " is elsewhere if the control skips line " + number + ": give " + letter +
         " in this block, or remove the '/' of line " + number;
}

void BlockSkip::pass(std::size_t i) {
  if (!any_) return;
  const Line& line = program_.lines[i];
  AxisSet set = 0;
  for (std::size_t w = 0; w < line.word_count; ++w)
    if (const std::size_t k = axis_of(program_.words[line.first_word + w].letter); k < axis_count)
      set |= only(k);
  const std::size_t first = next_;
  while (next_ < program_.moves.size() && program_.moves[next_].line == i) ++next_;
  if (next_ == first) {
    if (line.skip == 0) restated_ |= set;
    return;
  }
  const Move& move = program_.moves[next_ - 1];
  const std::size_t to = move.modal.work_offset;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const double shift = program_.zeros[work_offset_][k] - program_.zeros[to][k];
    words_[k] += shift;
    const bool moved = has(set, k) || !(std::abs(move.words[k] - words_[k]) <= same);
    for (std::size_t digit = 0; digit < switches_.size(); ++digit) {
      Skipped& one = switches_[digit];
      one.words[k] += shift;
      if (!moved) continue;
      if (digit != switch_of(line) || has(restated_ & ~set, k))
        one.words[k] = move.words[k];
      else
        one.by[k] = static_cast<std::uint32_t>(i);
    }
    words_[k] = move.words[k];
  }
  work_offset_ = to;
  restated_ = 0;
}

}  // namespace trueaxis::nc
