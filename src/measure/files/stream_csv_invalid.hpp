// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "measure/files/stream_csv.hpp"

namespace trueaxis {

/// Whether a field that is not a number has no value at all: empty, NaN, n/a, ---, or what a
/// spreadsheet writes of a formula that failed (#WERT!, #DIV/0!). "12,5" and "12.5 mm" hold one.
bool csv_is_no_value(std::string_view field);

/// Whether a line that begins with '#' is such a row of a table, not a comment: "#WERT!;12;5".
bool csv_is_row_of_no_value(const std::vector<std::string_view>& fields, std::size_t columns);

/// The rows of a file that hold no value somewhere, and that alone is wrong with them.
class CsvInvalidRows {
 public:
  /// @param field what is in the place of a value, as the file has it
  void add(std::size_t line, std::string_view field);
  bool any() const { return !lines_.empty(); }
  std::size_t count() const { return lines_.size(); }

  /// The remark with how many rows are excluded, in which lines, and why.
  std::string left_out(const std::function<std::size_t(std::size_t)>& line_of = {}) const;

  /// The command that excludes them, or the option alone if there is no `file` that it could read;
  /// empty if there are none, or hardly any others.
  std::string remedy(const std::string& file, const StreamReadOptions& options,
                     const std::vector<std::string>& words, std::size_t good) const;

 private:
  std::vector<std::size_t> lines_;
  std::vector<std::string> what_;  // different ones, in the order of the file
};

/// Why so many rows are not excluded even on request; empty if they are fewer than the others.
std::string csv_too_many_invalid(std::size_t invalid, std::size_t good);

}  // namespace trueaxis
