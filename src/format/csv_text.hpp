// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

inline bool csv_is_blank(char c) { return c == ' ' || c == '\t'; }

/// What keeps blanks and separators within a field.
enum class CsvKeep {
  brackets,  ///< a unit: X_M [mm dia]; blanks before the bracket do not separate either
  quotes,    ///< a field that begins with a quote; "" in it is a quote
};

/// Splits a line at `separator`; ' ' stands for runs of blanks. Every field is without outer blanks
/// and lies within `line`, an empty one too.
void csv_split(std::string_view line, char separator, std::vector<std::string_view>& fields,
               CsvKeep keep = CsvKeep::brackets);
std::vector<std::string_view> csv_fields(std::string_view line, char separator);

/// The first of , ; tab outside brackets, else blanks.
char csv_separator(std::string_view line);

/// Calls line(text, number) for the lines of a text, without line ends and byte order mark.
template <class Line>
void for_each_line(std::string_view text, Line&& line) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view one = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (one.ends_with('\r')) one.remove_suffix(1);
    line(one, number);
  }
}

/// The line up to a comment: a '#' that is first or follows a blank ("#N/A" is a field, no
/// comment).
std::string_view csv_without_comment(std::string_view line);

/// 1-based character of a byte of `line` (UTF-8: a multi-byte character counts once), or of a part
/// of it.
std::size_t csv_character(std::string_view line, std::size_t byte);
std::size_t csv_character(std::string_view line, std::string_view part);

/// `text` as UTF-8: unchanged where it is that already, else taken as Latin-1.
std::string csv_utf8(std::string_view text);

/// 'text' for a message: in quotes, control characters escaped, long text cut.
std::string csv_quoted(std::string_view text);

/// Collects what is wrong with one file; at most `max` places in it are listed, the rest counted.
/// Up to three places of one `kind` are listed each. If there are more, it lists the first, with
/// how many there are and the lines that come next. For a text that was made of a file, `line_of`
/// gives the file's lines (0: none), without columns.
class CsvDiagnostics {
 public:
  CsvDiagnostics(std::string file, std::size_t max,
                 std::function<std::size_t(std::size_t)> line_of = {})
      : file_(std::move(file)), max_(max), line_of_(std::move(line_of)) {}

  void add(std::size_t line, std::size_t column, std::string message, const std::string& kind = "");
  bool any() const { return !found_.empty() || more_ != 0; }
  /// A remark after everything that was found; it is not a mistake of its own.
  void remedy(std::string text) { remedy_ = std::move(text); }
  std::size_t line_of(std::size_t line) const { return line_of_ ? line_of_(line) : line; }
  /// Throws InputError with everything found, in line order, if anything was.
  void throw_if_any();

 private:
  std::string file_, remedy_;
  std::size_t max_, more_ = 0;
  std::function<std::size_t(std::size_t)> line_of_;
  std::vector<Diagnostic> found_;
  struct Kind {
    std::vector<std::size_t> listed;  ///< in `found_`, three at most
    std::size_t count = 0;
    std::vector<std::size_t> lines;  ///< the first of them
  };
  std::map<std::string, Kind> kinds_;
};

}  // namespace trueaxis
