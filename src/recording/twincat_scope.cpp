// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

constexpr double s_per_tick = 1e-7;  // 100 ns

std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  auto fields = csv_fields(line, separator);
  while (fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

/// Seconds from one count of ticks to another; there are some 1.3e17 since 1601, more than a double
/// tells apart, and what a file says may lie anywhere.
double seconds_between(std::int64_t from, std::int64_t to) {
  const auto a = static_cast<std::uint64_t>(from), b = static_cast<std::uint64_t>(to);
  return s_per_tick * (to < from ? -static_cast<double>(a - b) : static_cast<double>(b - a));
}

/// The number in a field of a keyed row, `otherwise` where the row or the field is not there; with
/// a decimal comma or a point, whatever the samples have. `wrong` gets what is not a number.
double keyed_number(const std::map<std::string, std::vector<std::string_view>>& keyed,
                    const std::string& key, std::size_t at, double otherwise, Recording& out) {
  const auto row = keyed.find(key);
  if (row == keyed.end() || at >= row->second.size() || row->second[at].empty()) return otherwise;
  double value = 0.0;
  for (const char decimal : {'.', ','})
    if (recorded_number(row->second[at], decimal, value)) return value;
  out.wrong.push_back({"", 0, 0, key + " " + csv_quoted(row->second[at]) + " is not a number"});
  return otherwise;
}

}  // namespace

bool read_twincat_scope(const RecordedText& text, Recording& out) {
  const auto starts = [&](std::size_t line, std::string_view with) {
    return line < text.lines.size() && text.lines[line].starts_with(with);
  };
  std::size_t head = 0;
  while (head < std::min<std::size_t>(text.lines.size(), 10) &&
         !starts(head, "Starttime of export"))
    ++head;
  constexpr std::string_view name = "Name", separators = ";\t,";
  if (!starts(head, "Starttime of export") || !starts(0, name) ||
      text.lines[0].size() == name.size() ||
      separators.find(text.lines[0][name.size()]) == std::string_view::npos)
    return false;
  const char separator = text.lines[0][name.size()];

  std::map<std::string, std::vector<std::string_view>> keyed;
  std::size_t first = head;
  for (; first < text.lines.size(); ++first) {
    const auto fields = fields_of(text.lines[first], separator);
    if (fields.size() > 1 && whole_number<std::int64_t>(fields[0])) break;
    if (fields.size() > 1) keyed[std::string(fields[0])] = fields;
  }
  const auto names = keyed.find("Name");
  if (names == keyed.end() || first == text.lines.size()) return false;
  out.decimal =
      separator == ',' ||
              text.text.find(',', static_cast<std::size_t>(text.lines[first].data() -
                                                           text.text.data())) == std::string::npos
          ? '.'
          : ',';
  const std::size_t columns = names->second.size();
  out.columns.push_back({"t", "s", "t", true});
  const auto unit_row = keyed.find("Unit");
  for (std::size_t k = 1; k < columns; ++k) {
    RecordedColumn column = recorded_column(names->second[k]);
    if (unit_row != keyed.end() && k < unit_row->second.size() && column.unit.empty())
      column.unit = unit_row->second[k];
    column.is_number = true;
    out.columns.push_back(std::move(column));
  }
  std::vector<double> scales(columns, 1.0), offsets(columns, 0.0);
  for (std::size_t k = 1; k < columns; ++k) {
    scales[k] = keyed_number(keyed, "ScaleFactor", k, 1.0, out);
    offsets[k] = keyed_number(keyed, "Offset", k, 0.0, out);
  }
  std::int64_t start_ticks = 0;
  for (std::size_t i = first; i < text.lines.size(); ++i) {
    auto fields = fields_of(text.lines[i], separator);
    if (fields.size() == 1 && fields[0].empty()) continue;
    const auto ticks = whole_number<std::int64_t>(fields[0]);
    if (!ticks || fields.size() > columns) {
      out.wrong.push_back({"", i + 1, 0,
                           ticks && separator == ','
                               ? "has more fields than there are names: where commas are both "
                                 "decimal marks and separators, export with semicolons"
                               : "is not a row of TICKS and values: remove it"});
      continue;
    }
    if (out.lines.empty()) start_ticks = *ticks;
    fields.resize(columns);
    out.lines.push_back(i + 1);
    out.cells.push_back(
        out.made.emplace_back(fmt::format("{:.17g}", seconds_between(start_ticks, *ticks))));
    for (std::size_t k = 1; k < columns; ++k) {
      const double scale = scales[k], offset = offsets[k];
      double value = 0.0;
      const bool number = recorded_number(fields[k], out.decimal, value);
      out.cells.push_back(
          number && (scale != 1.0 || offset != 0.0)
              ? out.made.emplace_back(fmt::format("{:.17g}", scale * value + offset))
              : fields[k]);
    }
  }
  // Cells that were made have points; the others' commas are theirs.
  if (out.decimal == ',')
    for (std::string& made : out.made) std::ranges::replace(made, '.', ',');
  out.producer = "a TwinCAT Scope export";
  return true;
}

}  // namespace trueaxis
