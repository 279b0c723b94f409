// SPDX-License-Identifier: Apache-2.0
#include "nc/mark.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "nc/axes.hpp"
#include "nc/lexer.hpp"
#include "nc/writer.hpp"

namespace trueaxis::nc {
namespace {

constexpr std::string_view mark = "COMPENSATED BY TRUEAXIS";

/// With `;` where a program has comments of that kind alone.
std::string written_mark(bool semicolon) {
  return semicolon ? " ; " + std::string(mark) : " (" + std::string(mark) + ")";
}

}  // namespace

std::string marked(std::string text) {
  const std::string written =
      written_mark(text.find(';') != std::string::npos && text.find('(') == std::string::npos);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t next = std::min(text.find('\n', begin), text.size());
    std::size_t end = next;
    if (end > begin && text[end - 1] == '\r') --end;
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    if (line.find_first_of("%(;") == std::string_view::npos &&
        line.size() + written.size() <= longest_line)
      return text.insert(end, written);
    begin = next + 1;
  }
  return text;
}

std::optional<std::size_t> marked_line(std::string_view text) {
  const auto found = std::ranges::search(text, mark, {}, upper_case);
  if (found.empty()) return {};
  return static_cast<std::size_t>(std::count(text.begin(), found.begin(), '\n')) + 1;
}

std::string without_mark(std::string text) {
  for (const bool semicolon : {false, true})
    if (const std::size_t at = text.find(written_mark(semicolon)); at != std::string::npos)
      text.erase(at, written_mark(semicolon).size());
  return text;
}

namespace {

/// What compensation may change: axis words, and F with its mode where only rotary axes turn.
bool may_change(const Word& word) {
  return axis_of(word.letter) < axis_count || word.letter == 'F' ||
         (word.letter == 'G' && (word.number == 93.0 || word.number == 94.0));
}

/// A program without the words that may change, the blanks before them, the lines that hold nothing
/// else, and the mark.
std::string skeleton_of(std::string_view program) {
  const std::string text = without_mark(std::string(program));
  std::vector<Diagnostic> ignored;
  const Lexed lexed = lex(text, "", ignored);
  std::string out;
  for (const Line& line : lexed.lines) {
    const std::size_t begin = out.size();
    std::size_t copied = line.begin;
    bool axes = false;
    for (std::uint32_t i = 0; i < line.word_count; ++i) {
      const Word& word = lexed.words[line.first_word + i];
      if (!may_change(word)) continue;
      out.append(text, copied, word.letter_at - copied);
      while (out.size() > begin && is_blank(out.back())) out.pop_back();
      copied = word.end;
      axes = true;
    }
    out.append(text, copied, line.end - copied);
    if (axes && out.find_first_not_of("/0123456789 \t", begin) == std::string::npos)
      out.resize(begin);
    else
      out += '\n';
  }
  return out;
}

}  // namespace

bool differ_in_axis_words_only(std::string_view one, std::string_view other) {
  const std::string skeleton = skeleton_of(one);
  return !skeleton.empty() && skeleton == skeleton_of(other);
}

}  // namespace trueaxis::nc
