// SPDX-License-Identifier: Apache-2.0
#include "simulate/machine/block_words.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "base/number.hpp"
#include "base/text.hpp"

namespace trueaxis::virtual_machine {
namespace {

/// What of a line is carried out: in upper case, without blanks, comments and the sign of a block
/// that may be skipped.
std::string carried_out(const std::string& line) {
  std::string out;
  bool comment = false;
  for (const char c : line) {
    if (c == ';' && !comment) break;
    if (c == '(') comment = true;
    if (!comment && std::isspace(static_cast<unsigned char>(c)) == 0) out += upper_case(c);
    if (c == ')') comment = false;
  }
  if (out.starts_with("\xEF\xBB\xBF")) out.erase(0, 3);
  if (!out.starts_with('/')) return out;
  const bool numbered = out.size() > 1 && std::isdigit(static_cast<unsigned char>(out[1])) != 0;
  return out.substr(numbered ? 2 : 1);
}

/// Sorts "G1X100.Y-.5"; the place of what is not a word, else npos.
std::size_t take_words(const std::string& text, BlockWords& block) {
  static constexpr const char* of_numbers = "+-.0123456789";
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    const std::size_t end = std::min(text.find_first_not_of(of_numbers, at + 1), text.size());
    double value = 0.0;
    const bool is_number = parse_number(std::string_view(text).substr(at + 1, end - at - 1), value);
    if (letter < 'A' || letter > 'Z' || !is_number) return at;
    if (letter == 'G')
      block.g.push_back(value);
    else if (letter == 'M')
      block.m.push_back(value);
    else if (!block.of_letter.emplace(letter, value).second)
      return at;  // twice
    at = end;
  }
  return std::string::npos;
}

}  // namespace

bool BlockWords::has_g(double code) const { return std::ranges::find(g, code) != g.end(); }
bool BlockWords::has_m(double code) const { return std::ranges::find(m, code) != m.end(); }

std::vector<BlockWords> words_of_blocks(std::string_view program, const std::string& file,
                                        std::vector<Diagnostic>& wrong) {
  std::vector<BlockWords> blocks;
  std::istringstream lines{std::string(program)};
  std::size_t number = 0;
  int tape_marks = 0;
  for (std::string line; tape_marks < 2 && std::getline(lines, line);) {
    ++number;
    const std::string text = carried_out(line);
    if (text.starts_with('%')) {
      ++tape_marks;
      continue;
    }
    BlockWords block;
    block.line = number;
    const std::size_t bad = take_words(text, block);
    if (bad != std::string::npos)
      wrong.push_back({file, number, 0,
                       "the control does not read `" + text.substr(bad) +
                           "`: a word is a letter, once in a block, and a number"});
    else if (!text.empty())
      blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace trueaxis::virtual_machine
