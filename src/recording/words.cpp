// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {

std::vector<RecordedWord> recorded_words(std::string_view line) {
  std::vector<RecordedWord> words;
  std::size_t at = 0;
  const auto skip = [&] {
    while (at < line.size() && (csv_is_blank(line[at]) || line[at] == '*')) ++at;
  };
  for (skip(); at < line.size(); skip()) {
    const char letter = line[at];
    if (!is_letter(letter)) return {};
    ++at;
    skip();
    if (at < line.size() && line[at] == '=') ++at;
    skip();
    double value = 0.0;
    std::errc error{};
    const char* begin = line.data() + at;
    const char* end = line.data() + line.size();
    const char* stop = read_number(begin, end, value, error);
    if (stop == begin) return {};
    words.push_back({upper_case(letter), {begin, static_cast<std::size_t>(stop - begin)}});
    at += static_cast<std::size_t>(stop - begin);
  }
  return words;
}

bool read_words(const RecordedText& text, Recording& out) {
  std::size_t others = 0;
  std::string first_other;
  std::vector<char> letters;
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const std::string_view line = trimmed(text.lines[i]);
    if (line.empty() || line == "%") continue;
    if (line.starts_with('#')) {
      take_comment(line, i + 1, out);
      continue;
    }
    const std::vector<RecordedWord> words = recorded_words(line);
    const bool codes = std::ranges::all_of(
        words, [](const RecordedWord& word) { return word.letter == 'G' || word.letter == 'M'; });
    if (words.size() < 2 || codes) {
      if (others++ == 0) first_other = csv_quoted(line);
      take_title(line, out);
      continue;
    }
    if (letters.empty())
      for (const RecordedWord& word : words) letters.push_back(word.letter);
    std::vector<std::string_view> row(letters.size());
    for (const RecordedWord& word : words) {
      const auto found = std::ranges::find(letters, word.letter);
      if (found == letters.end()) {
        out.wrong.push_back({"", i + 1, 0,
                             fmt::format("the word {} is in no earlier row: record the same words "
                                         "in every row",
                                         word.letter)});
      } else {
        row[static_cast<std::size_t>(found - letters.begin())] = word.number;
      }
    }
    out.lines.push_back(i + 1);
    out.cells.insert(out.cells.end(), row.begin(), row.end());
  }
  if (out.rows() < 2 || others > out.rows()) return false;
  for (const char letter : letters) {
    const std::string name(1, letter);
    out.columns.push_back({name, "", name, true});
  }
  if (others > 0)
    out.notes.push_back(
        fmt::format("{} passed over: {}{}",
                    counted(others, "line without words of a letter and a number is",
                            "lines without words of a letter and a number are"),
                    first_other, others > 1 ? " …" : ""));
  out.producer = "words of a letter and a number, as DPRNT prints them";
  return true;
}

}  // namespace trueaxis
