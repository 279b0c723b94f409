// SPDX-License-Identifier: Apache-2.0
#include "machine/files/number_table.hpp"

#include <charconv>
#include <cmath>

#include "format/file.hpp"

namespace trueaxis {

std::vector<std::string_view> fields_of(std::string_view line) {
  const bool separated = line.find_first_of(",;") != std::string_view::npos;
  const std::string_view separators = separated ? ",;" : " \t", blanks = " \t\r";
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= line.size();) {
    std::size_t end = line.find_first_of(separators, at);
    if (end == std::string_view::npos) end = line.size();
    std::string_view field = line.substr(at, end - at);
    const std::size_t first = field.find_first_not_of(blanks);
    field = first == std::string_view::npos
                ? ""
                : field.substr(first, field.find_last_not_of(blanks) - first + 1);
    if (separated || !field.empty()) fields.push_back(field);
    at = end + 1;
  }
  return fields;
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  return wrong == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

NumberTable read_number_table(const std::string& path, std::vector<Diagnostic>& wrong) {
  const std::string content = read_file(path);
  NumberTable table;
  std::size_t number = 0;
  for (std::size_t at = content.starts_with("\xEF\xBB\xBF") ? 3 : 0; at < content.size();) {
    std::size_t end = content.find('\n', at);
    if (end == std::string::npos) end = content.size();
    std::string_view line(content.data() + at, end - at);
    at = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto fields = fields_of(line);
    if (table.header.empty()) {
      table.header.assign(fields.begin(), fields.end());
      table.header_line = number;
      continue;
    }
    NumberTable::Row row{number, {}};
    if (fields.size() != table.header.size())
      wrong.push_back({path, number, 0,
                       "has " + std::to_string(fields.size()) + " numbers, the header " +
                           std::to_string(table.header.size()) + " columns"});
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double value = 0.0;
      if (parse_number(fields[i], value))
        row.values.push_back(value);
      else
        wrong.push_back({path, number, 0, '"' + std::string(fields[i]) + "\" is no finite number"});
    }
    if (row.values.size() == table.header.size()) table.rows.push_back(std::move(row));
  }
  if (table.header.empty())
    wrong.push_back({path, 0, 0, "has no header"});
  else if (table.rows.empty() && wrong.empty())
    wrong.push_back({path, 0, 0, "has no rows"});
  return table;
}

}  // namespace trueaxis
