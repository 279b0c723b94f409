// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis::nc {

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// A letter and its number, as they are in the text: `letter_at` is the place of the letter,
/// [number_begin, end) that of the number with its sign.
struct Word {
  char letter = 0;            ///< upper case
  std::uint8_t decimals = 0;  ///< digits after the point
  std::uint32_t letter_at = 0, number_begin = 0, end = 0;
  double number = 0.0;  ///< as written, in the program's unit
};

/// A line of the text without its end, and its words.
struct Line {
  std::uint32_t begin = 0, end = 0;  ///< [begin, end); its line end follows
  std::uint32_t first_word = 0;
  std::uint16_t word_count = 0;
  char skip = 0;            ///< the digit after a '/' at its start, '/' where there is none
  bool has_blanks = false;  ///< outside of comments

  std::string skip_text() const {
    if (skip == 0) return "";
    return skip == '/' ? "/" : std::string{'/', skip};
  }
};

/// A program taken apart. The lines and their ends are the text: nothing is lost.
struct Lexed {
  std::vector<Line> lines;
  std::vector<Word> words;
};

/// Takes a program apart: words, comments `( )` and `;`, `/` (and a digit) at the start, `%` lines;
/// words after the second `%`, which a control does not read, are wrong. What cannot be read is
/// added to `wrong`, and the rest of that line is left.
Lexed lex(std::string_view text, const std::string& file, std::vector<Diagnostic>& wrong);

/// Place of a byte as a diagnostic tells it: 1-based character of its line.
std::size_t column_of(std::string_view text, const Line& line, std::size_t at);

}  // namespace trueaxis::nc
