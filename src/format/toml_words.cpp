// SPDX-License-Identifier: Apache-2.0
#include "format/toml_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace trueaxis {

std::string number_text(double value) { return fmt::format("{:.12g}", value); }

std::string range_text(const Range& range, double factor) {
  const std::string low = number_text(range.low / factor);
  const std::string high = number_text(range.high / factor);
  if (std::isinf(range.high)) return (range.low_open ? "more than " : "at least ") + low;
  if (std::isinf(range.low)) return (range.high_open ? "less than " : "at most ") + high;
  return std::string("in ") + (range.low_open ? '(' : '[') + low + ", " + high +
         (range.high_open ? ')' : ']');
}

bool contains(const Range& range, double value) {
  return (range.low_open ? value > range.low : value >= range.low) &&
         (range.high_open ? value < range.high : value <= range.high);
}

std::string type_text(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  const bool vowel = std::string_view("aeiou").find(text.str().front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + text.str();
}

std::string backslash_hint(std::string_view content, std::size_t number) {
  for (std::size_t line = 1; line < number; ++line) {
    const std::size_t end = content.find('\n');
    if (end == std::string_view::npos) return "";
    content.remove_prefix(end + 1);
  }
  content = content.substr(0, content.find('\n'));
  const std::size_t quote = content.find('"');
  const bool escape =
      quote != std::string_view::npos && content.find('\\', quote) != std::string_view::npos;
  return escape ? std::string(": ") + backslash_advice : "";
}

bool holds_control_character(std::string_view text) {
  return std::ranges::any_of(text, [](unsigned char c) { return c < 0x20U || c == 0x7FU; });
}

}  // namespace trueaxis
