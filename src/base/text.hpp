// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
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

/// Takes `word` off the front, where it stands there.
inline bool take_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// The letters of ASCII only, in any locale.
inline char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }
inline char upper_case(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; }

inline std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = lower_case(c);
  return out;
}

}  // namespace trueaxis
