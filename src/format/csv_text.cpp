// SPDX-License-Identifier: Apache-2.0
#include "format/csv_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "format/folded.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_listed = 3;  // places of one kind

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Bytes of the UTF-8 character that starts `text`; 0 where none does.
std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80U                    ? 1
                             : lead >= 0xC2U && lead < 0xE0U ? 2
                             : lead >= 0xE0U && lead < 0xF0U ? 3
                             : lead >= 0xF0U && lead < 0xF5U ? 4
                                                             : 0;
  if (length == 0 || length > text.size()) return 0;
  return std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length),
                     is_continuation)
             ? length
             : 0;
}

}  // namespace

void csv_split(std::string_view line, char separator, std::vector<std::string_view>& fields,
               CsvKeep keep) {
  fields.clear();
  const bool blanks = separator == ' ', quotes = keep == CsvKeep::quotes;
  const auto is_blank = [&](char c) { return c == ' ' || (c == '\t' && separator != '\t'); };
  const auto ends_field = [&](char c) { return blanks ? is_blank(c) : c == separator; };
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && is_blank(line[at])) ++at;
  };
  while (true) {
    skip_blanks();
    if (blanks && at == line.size()) return;
    std::size_t begin = at, end = line.size();
    if (quotes && at < line.size() && line[at] == '"') {
      begin = ++at;
      while (at < line.size() && (line[at] != '"' || line.substr(at).starts_with("\"\"")))
        at += line[at] == '"' ? 2 : 1;
      end = std::min(at, line.size());
      at = std::min(line.find(separator, end), line.size());
    } else {
      bool in_bracket = false;
      for (; at < line.size(); ++at) {
        if (!quotes && line[at] == '[') in_bracket = true;
        if (line[at] == ']') in_bracket = false;
        if (in_bracket || !ends_field(line[at])) continue;
        end = at;
        if (!blanks) break;
        skip_blanks();
        if (quotes || at == line.size() || line[at] != '[') break;
        end = line.size();
        --at;
      }
    }
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    if (at == line.size()) return;
    if (!blanks || line[at] == separator) ++at;
  }
}

std::vector<std::string_view> csv_fields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  csv_split(line, separator, fields);
  return fields;
}

char csv_separator(std::string_view line) {
  bool in_bracket = false;
  for (const char c : line) {
    if (c == '[') in_bracket = true;
    if (c == ']') in_bracket = false;
    if (!in_bracket && (c == ',' || c == ';' || c == '\t')) return c;
  }
  return ' ';
}

std::string_view csv_without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1)) {
    if (at == 0 || csv_is_blank(line[at - 1])) return line.substr(0, at);
  }
  return line;
}

std::size_t csv_character(std::string_view line, std::size_t byte) {
  return 1 + layout::width(line.substr(0, byte));
}

std::size_t csv_character(std::string_view line, std::string_view part) {
  return csv_character(line, static_cast<std::size_t>(part.data() - line.data()));
}

std::string csv_utf8(std::string_view text) {
  bool valid = true;
  for (std::size_t i = 0; valid && i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    valid = length != 0;
    i += length;
  }
  if (valid) return std::string(text);
  std::string out;
  for (const char c : text) append_utf8(out, static_cast<unsigned char>(c));
  return out;
}

std::string csv_quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::size_t cut = std::min(text.size(), longest);
  while (cut < text.size() && cut > longest - 4 && is_continuation(text[cut])) --cut;
  std::string out = "'";
  for (const char c : csv_utf8(text.substr(0, cut))) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20U && byte != 0x7FU) {
      out += c;
    } else {
      out += fmt::format("\\x{:02x}", byte);
    }
  }
  return out + (cut < text.size() ? "…'" : "'");
}

void CsvDiagnostics::add(std::size_t line, std::size_t column, std::string message,
                         const std::string& kind) {
  constexpr std::size_t most_lines = 7;
  if (line_of_) {
    line = line_of(line);
    column = 0;
  }
  if (!kind.empty()) {
    Kind& of = kinds_[kind];
    ++of.count;
    if (of.lines.size() < most_lines) of.lines.push_back(line);
    if (of.count > most_listed) return;
    of.listed.push_back(found_.size());
  }
  if (found_.size() < max_) {
    found_.push_back({file_, line, column, std::move(message)});
  } else {
    ++more_;
  }
}

void CsvDiagnostics::throw_if_any() {
  if (!any()) return;
  std::vector<bool> dropped(found_.size(), false);
  for (const auto& [kind, of] : kinds_) {
    if (of.count <= most_listed || of.listed.front() >= found_.size()) continue;
    for (const std::size_t at : of.listed)
      if (at < found_.size()) dropped[at] = at != of.listed.front();
    const std::vector<std::size_t> next(of.lines.begin() + 1, of.lines.end());
    found_[of.listed.front()].message +=
        fmt::format(" (so too in {} further places, in lines {}{})", of.count - 1,
                    fmt::join(next, ", "), of.count > of.lines.size() ? " …" : "");
  }
  std::size_t at = 0;
  std::erase_if(found_, [&](const Diagnostic&) { return dropped[at++]; });
  std::stable_sort(found_.begin(), found_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  if (more_ != 0) found_.push_back({file_, 0, 0, "and " + std::to_string(more_) + " more"});
  if (!remedy_.empty()) found_.push_back({file_, 0, 0, remedy_});
  throw InputError(std::move(found_));
}

}  // namespace trueaxis
