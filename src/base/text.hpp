// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace trueaxis {

inline constexpr std::string_view blanks_of_line = " \t\r";
inline constexpr std::string_view blanks_of_text = " \t\r\n\v\f";

/// `text` without blanks at both ends; it lies within `text`, an empty one too.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = blanks_of_line) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Removes `word` from the front, if it is there.
inline bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// Adds a word to a list of them: "a, b".
inline void add_to_list(std::string& list, std::string_view word, std::string_view between = ", ") {
  if (!list.empty()) list += between;
  list += word;
}

/// "a, b": what `word_of` says of each of `all`, its text or the name of a member.
template <class All, class Word = std::identity>
std::string word_list(const All& all, std::string_view between = ", ", Word word_of = {}) {
  std::string list;
  for (const auto& one : all) add_to_list(list, std::invoke(word_of, one), between);
  return list;
}

/// The letters of ASCII only, in any locale.
inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
inline char upper_case(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; }

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = lower_case(c);
  return out;
}

/// Levenshtein's distance: letters to change, put in or take out; for "did you mean".
std::size_t edit_distance(std::string_view from, std::string_view to);

}  // namespace trueaxis
