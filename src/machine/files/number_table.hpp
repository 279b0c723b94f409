// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// A small table of numbers under a header, read strictly: separators `,` `;` tab or blanks,
/// comments behind `#`.
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

/// The fields of a line, without blanks around them.
std::vector<std::string_view> fields_of(std::string_view line);

/// A finite number that is all of `text`; a sign + is allowed.
bool parse_number(std::string_view text, double& value);

}  // namespace trueaxis
