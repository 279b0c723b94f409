// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// A small table of numbers under a header, read strictly: separators `,` `;` tab or blanks,
/// comments after `#`.
struct NumberTable {
  struct Row {
    std::size_t line = 0;
    std::vector<double> values;
  };
  std::vector<std::string> header;  ///< as written
  std::size_t header_line = 0;
  std::vector<Row> rows;  ///< those that are as wide as the header and hold finite numbers
};

/// What is wrong is added to `wrong`.
NumberTable read_number_table(const std::string& path, std::vector<Diagnostic>& wrong);
/// The same of what the file holds.
NumberTable number_table(std::string_view content, const std::string& path,
                         std::vector<Diagnostic>& wrong);

/// The fields of a line between commas, semicolons or blanks, without blanks around them.
std::vector<std::string_view> fields_of(std::string_view line);

}  // namespace trueaxis
