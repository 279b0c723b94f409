// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text.hpp"
#include "interchange/number_file.hpp"
#include "recording/recording.hpp"

namespace trueaxis {

Recording recorded_numbers(const std::string& path, const std::string& bytes) {
  const NumberFile file = read_number_file(path, bytes);
  std::size_t longest = 0;
  for (const NumberArray& array : file.arrays)
    if (array.unusable.empty()) longest = std::max(longest, array.rows);
  Recording out;
  out.producer = file.kind;
  out.notes = file.notes;
  out.of_numbers = true;
  for (const NumberArray& array : file.arrays)
    if (!array.unusable.empty() || array.rows != longest)
      out.left_out.push_back(fmt::format(
          "{} ({})", array.name,
          array.unusable.empty() ? fmt::format("{} rows", array.rows) : array.unusable));
  if (!out.left_out.empty())
    out.notes.push_back(
        fmt::format("not among the {} rows: {}", longest, fmt::join(out.left_out, ", ")));
  const auto own_name = [](const NumberArray& array) {
    return std::string_view(array.name).substr(array.name.find_last_of('/') + 1);
  };
  for (const NumberArray& shorter : file.arrays) {
    const auto of_same_name = std::ranges::find_if(file.arrays, [&](const NumberArray& array) {
      return array.unusable.empty() && array.rows == longest &&
             own_name(array) == own_name(shorter);
    });
    if (!shorter.unusable.empty() || shorter.rows == longest || of_same_name == file.arrays.end())
      continue;
    out.unclear.push_back(
        fmt::format("{} ({} rows) and {} ({} rows) could both be {}: say which in "
                    "--columns, or write all passes into one array",
                    shorter.name, shorter.rows, of_same_name->name, longest, own_name(shorter)));
    break;
  }
  std::vector<NumberColumn> columns = number_columns(file);
  std::erase_if(columns, [&](const NumberColumn& column) { return column.array->rows != longest; });
  for (const NumberColumn& column : columns) {
    RecordedColumn one = recorded_column(column.name);  // "C[deg]" of a variable's own name
    one.name = one.name.substr(one.name.find_last_of('/') + 1);
    if (!column.array->unit.empty()) one.unit = column.array->unit;
    one.is_number = true;
    out.columns.push_back(std::move(one));
  }
  for (std::size_t row = 0; row < longest; ++row) {
    out.lines.push_back(row + 1);
    for (const NumberColumn& column : columns)
      out.numbers.push_back(column.array->at(row, column.column));
  }
  if (columns.size() > 64)
    out.unclear.push_back(
        fmt::format("it has {} columns of {} rows: where a reading is a column, transpose it",
                    columns.size(), longest));
  return out;
}

}  // namespace trueaxis
