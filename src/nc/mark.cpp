// SPDX-License-Identifier: Apache-2.0
#include "nc/mark.hpp"

#include <algorithm>

#include "base/text.hpp"
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

}  // namespace trueaxis::nc
