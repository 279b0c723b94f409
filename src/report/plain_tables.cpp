// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number.hpp"
#include "format/html.hpp"
#include "report/page.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_numbers = 16;   // of a column that is a list and no chart
constexpr std::size_t most_open = 12'000;  // characters of a part that is open
constexpr std::size_t most_columns = 12;   // of a table with a row an element

/// A member's name as words; x0 and U of an axis stay as they are.
std::string words(std::string key) {
  std::ranges::replace(key, '_', ' ');
  return escape_html(key);
}

std::string title(std::string key) {
  std::string text = words(std::move(key));
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

bool is_quantity(const Json& json) { return json.is_object() && json.contains("value"); }

std::string number_text(double value, double u) {
  if (!std::isfinite(value)) return "–";
  if (u > 0.0) return fmt::format("{:.{}f}", value, decimals_of(u));
  return fmt::format("{:.6g}", value);
}

std::string scalar_text(const Json& json) {
  if (json.is_null()) return "–";
  if (json.is_boolean()) return json.get<bool>() ? "yes" : "no";
  if (json.is_string()) return escape_html(json.get_ref<const std::string&>());
  if (json.is_number_float()) return number_text(json.get<double>(), 0.0);
  return json.dump();
}

/// "0.0802 mm (u 0.0003 mm)", and what else is next to the value.
std::string quantity_text(const Json& json) {
  const Json& value = json.at("value");
  const double u = json.contains("u") && json["u"].is_number() ? json["u"].get<double>() : 0.0;
  std::string text = value.is_number() ? number_text(value.get<double>(), u) : scalar_text(value);
  const std::string unit = json.contains("unit") ? scalar_text(json["unit"]) : "";
  const std::string behind = unit.empty() || unit == "1" ? "" : " " + unit;
  text += behind;
  if (u > 0.0) text += fmt::format(" (u {}{})", significant(u, 2), behind);
  for (const auto& [key, more] : json.items())
    if (key != "value" && key != "u" && key != "unit" && more.is_primitive() && !more.is_null())
      text += ", " + words(key) + " " + scalar_text(more);
  return text;
}

/// An array that fits into a cell.
bool is_list(const Json& json) {
  return json.is_array() &&
         std::ranges::all_of(json, [](const Json& one) { return one.is_primitive(); });
}

std::string list_text(const Json& list) {
  const bool numbers =
      std::ranges::all_of(list, [](const Json& one) { return one.is_number() || one.is_null(); });
  if (numbers && list.size() > most_numbers) return fmt::format("{} numbers", list.size());
  std::string text;
  for (const Json& one : list)
    text += (text.empty() ? "" : numbers ? ", " : "; ") + scalar_text(one);
  return text.empty() ? "none" : text;
}

bool is_cell(const Json& json) { return json.is_primitive() || is_quantity(json) || is_list(json); }

std::string cell_text(const Json& json) {
  return is_quantity(json) ? quantity_text(json)
         : is_list(json)   ? list_text(json)
                           : scalar_text(json);
}

std::string table_of(const std::string& head, const std::string& rows) {
  return "<div class=\"table\"><div class=\"scroll\" tabindex=\"0\"><table class=\"plain\">" +
         head + "<tbody>" + rows + "</tbody></table></div></div>\n";
}

bool all_rows(const Json& array) {
  return array.is_array() && !array.empty() && std::ranges::all_of(array, [](const Json& one) {
           return one.is_object() && one.size() <= most_columns && !is_quantity(one) &&
                  std::ranges::all_of(one, is_cell);
         });
}

std::string rows_table(const Json& array) {
  std::vector<std::string> columns;
  for (const Json& one : array)
    for (const auto& [key, value] : one.items())
      if (std::ranges::find(columns, key) == columns.end()) columns.push_back(key);
  std::string head, rows;
  for (const std::string& column : columns)
    head += "<th scope=\"col\" class=\"text\">" + words(column) + "</th>";
  for (const Json& one : array) {
    rows += "<tr>";
    for (const std::string& column : columns)
      rows += "<td>" + (one.contains(column) ? cell_text(one[column]) : "") + "</td>";
    rows += "</tr>";
  }
  return table_of("<thead><tr>" + head + "</tr></thead>", rows);
}

/// What an element of an array is called.
std::string name_of_element(const Json& one, std::size_t place) {
  if (one.is_object())
    for (const char* key : {"name", "title", "effect", "reference", "id"})
      if (one.contains(key) && one[key].is_string()) return scalar_text(one[key]);
  return fmt::format("{}", place + 1);
}

std::string content_of(const Json& json, int depth);

/// A named part: a section, below it a block, deeper a fold.
std::string part(const std::string& name, const Json& json, int depth) {
  const std::string inner = content_of(json, depth + 1);
  if (inner.empty()) return "";
  if (depth == 0) return "<section><h2>" + name + "</h2>\n" + inner + "</section>\n";
  if (depth == 1) return "<div class=\"block\"><h3>" + name + "</h3>\n" + inner + "</div>\n";
  const char* open = inner.size() < most_open ? " open" : "";
  return std::string("<details") + open + "><summary>" + name + "</summary>\n" + inner +
         "</details>\n";
}

std::string content_of(const Json& json, int depth) {
  if (is_cell(json)) return json.empty() ? "" : "<p>" + cell_text(json) + "</p>\n";
  if (all_rows(json)) return rows_table(json);
  std::string text;
  if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i)
      text += part(name_of_element(json[i], i), json[i], depth);
    return text;
  }
  std::string rows;
  for (const auto& [key, value] : json.items())
    if (is_cell(value) && !(value.is_string() && value.get_ref<const std::string&>().empty()))
      rows += "<tr><th scope=\"row\" class=\"text\">" + words(key) + "</th><td>" +
              cell_text(value) + "</td></tr>";
  if (!rows.empty()) text += table_of("", rows);
  for (const auto& [key, value] : json.items())
    if (!is_cell(value)) text += part(depth < 2 ? title(key) : words(key), value, depth);
  return text;
}

}  // namespace

std::string plain_tables(const Json& result) { return content_of(result, 0); }

}  // namespace trueaxis
