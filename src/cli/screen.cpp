// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string_view>

#include "base/text.hpp"
#include "cli/terminal.hpp"
#include "format/text_layout.hpp"
#include "platform/terminal.hpp"

namespace trueaxis::cli {
namespace {

constexpr std::size_t text_column = 7;  // where the text of a line begins after its word

std::size_t width_of_terminal() {
  const auto columns = platform::columns_of(platform::Stream::output);
  return columns ? std::clamp<std::size_t>(*columns, 50, 140) : layout::columns;
}

bool on_terminal() { return platform::is_terminal(platform::Stream::output); }
bool in_colour() { return on_terminal() && std::getenv("NO_COLOR") == nullptr; }

/// The escape code of a verdict: green for a go, red for a stop, yellow for what lies between.
const char* colour_of(const std::string& line) {
  const auto starts = [&](const char* with) { return line.starts_with(with); };
  if (starts("GO with") || starts("NOT PROVEN") || starts("EFFECTS")) return "\x1b[1;33m";
  if (starts("GO") || starts("IDEAL") || starts("DONE") || starts("FITTED")) return "\x1b[1;32m";
  if (starts("NO-GO") || starts("UNEXPLAINED") || starts("NOT ")) return "\x1b[1;31m";
  return "\x1b[1m";
}

/// Blanks between a number and its unit, about ± and =, as a sign that no line is broken at; back
/// again where it is.
constexpr char bound = '\x1f';

std::string with_units_bound(std::string text) {
  for (const std::string_view unit :
       {"µm", "mm", "µrad", "mrad", "nm", "deg", "rpm", "min", "Hz", "ms", "s", "%", "°", "UPR"})
    for (std::size_t at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1)) {
      const std::size_t end = at + unit.size();
      if (at > 1 && text[at - 1] == ' ' && is_digit(text[at - 2]) &&
          (end == text.size() || !is_letter(text[end])))
        text[at - 1] = bound;
    }
  for (const std::string_view sign : {" ± ", " = "})
    for (std::size_t at = text.find(sign); at != std::string::npos; at = text.find(sign, at + 1)) {
      text[at] = bound;
      text[at + sign.size() - 1] = bound;
    }
  for (std::size_t at = text.find("± "); at != std::string::npos; at = text.find("± ", at + 1))
    text[at + std::string_view("±").size()] = bound;
  return text;
}

}  // namespace

CLI::Option* add_verbose(CLI::App& command, bool& verbose) {
  return command.add_flag("-v,--verbose", verbose, "print all details");
}

void print_screen(const std::string& text) {
  const std::size_t width = width_of_terminal();
  std::istringstream lines(text);
  bool first = true;
  for (std::string line; std::getline(lines, line); first = false) {
    const bool headed = !first && line.size() > text_column;
    const std::string head = headed ? line.substr(0, text_column) : std::string();
    const std::string text_of_line = with_units_bound(headed ? line.substr(text_column) : line);
    // A script takes the first line as it is.
    const std::size_t to = first && !on_terminal() ? text.size() : width;
    std::string out = layout::wrapped(head, text_of_line, to);
    std::ranges::replace(out, bound, ' ');
    if (first && in_colour()) {
      const std::size_t end = std::min(out.find_first_of(":\n"), out.size());
      out = colour_of(line) + out.substr(0, end) + "\x1b[0m" + out.substr(end);
    }
    std::cout << out;
  }
}

}  // namespace trueaxis::cli
