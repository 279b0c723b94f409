// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "format/csv_text.hpp"
#include "format/folded.hpp"
#include "format/units.hpp"
#include "measure/files/stream_csv_metadata.hpp"
#include "recording/header_words.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

/// Whether a word in small letters says inch; `last`: none comes after it, as one does after the
/// preposition "in".
bool is_inch(std::string_view word, bool last) {
  return word == "imperial" || word == "g20" || word == "g70" ||
         (unit_of_word(word) == "in" && (word.size() > 2 || (word == "in" && last)));
}

bool is_convention(std::string_view word, bool last) {
  const auto name = read_header_name(word);
  const bool of_reading =
      name && (name->meaning == HeaderMeaning::radius || name->meaning == HeaderMeaning::diameter);
  return is_inch(word, last) || (of_reading && word.size() > 1) || word.starts_with("unit") ||
         word.starts_with("einheit") || word.starts_with("durchmesser");
}

bool any_word(std::string_view line, bool (&says)(std::string_view, bool)) {
  const std::string text = folded(line);
  constexpr std::string_view between = " \t:;,|=()[]\"#%/_.";
  const std::size_t end = text.find_last_not_of(between) + 1;
  for (std::size_t at = 0; at < end;) {
    const std::size_t stop = std::min(text.find_first_of(between, at), end);
    if (says(std::string_view(text).substr(at, stop - at), stop == end)) return true;
    at = stop + 1;
  }
  return false;
}

}  // namespace

void take_title(std::string_view line, Recording& out) {
  if (any_word(line, is_convention))
    out.unclear.push_back("a line of the file says " + csv_quoted(trimmed(line)) +
                          ": say in --columns what the columns are, with their units");
}

void take_comment(std::string_view line, std::size_t number, Recording& out) {
  const std::string_view key = csv_known_key(line), said = trimmed(line).substr(1);
  out.metadata.emplace_back(trimmed(line));
  if (!key.empty())
    out.keys.push_back({number, csv_character(line, key), out.rows(), std::string(key)});
  // What the reader of streams refuses in a comment is left to it.
  else if (!said.starts_with('#') && csv_comment_trouble(said).empty() && any_word(said, is_inch))
    take_title(line, out);
}

}  // namespace trueaxis
