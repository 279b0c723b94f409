// SPDX-License-Identifier: Apache-2.0
#include "machine/files/number_table.hpp"

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"

namespace trueaxis {

std::vector<std::string_view> fields_of(std::string_view line) {
  const std::size_t mark = line.find_first_of(",;");
  return csv_fields(line, mark == std::string_view::npos ? ' ' : line[mark]);
}

NumberTable read_number_table(const std::string& path, std::vector<Diagnostic>& wrong) {
  return number_table(read_file(path), path, wrong);
}

NumberTable number_table(std::string_view content, const std::string& path,
                         std::vector<Diagnostic>& wrong) {
  NumberTable table;
  for_each_line(content, [&](std::string_view line, std::size_t number) {
    line = line.substr(0, line.find('#'));
    if (trimmed(line).empty()) return;
    const auto fields = fields_of(line);
    if (table.header.empty()) {
      table.header.assign(fields.begin(), fields.end());
      table.header_line = number;
      return;
    }
    NumberTable::Row row{number, {}};
    if (fields.size() != table.header.size())
      wrong.push_back({path, number, 0,
                       "has " + std::to_string(fields.size()) + " numbers, the header " +
                           std::to_string(table.header.size()) + " columns"});
    for (const std::string_view field : fields) {
      double value = 0.0;
      if (parse_number(field, value))
        row.values.push_back(value);
      else
        wrong.push_back({path, number, 0, '"' + std::string(field) + "\" is not a finite number"});
    }
    if (row.values.size() == table.header.size()) table.rows.push_back(std::move(row));
  });
  if (table.header.empty())
    wrong.push_back({path, 0, 0, "has no header"});
  else if (table.rows.empty() && wrong.empty())
    wrong.push_back({path, 0, 0, "has no rows"});
  return table;
}

}  // namespace trueaxis
