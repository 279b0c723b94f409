// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/folded.hpp"
#include "format/units.hpp"
#include "recording/header_words.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

/// UTF-16 after its byte order mark, as a spreadsheet's "Unicode text" is.
std::string from_utf16(std::string_view bytes, bool little) {
  std::string out;
  const auto unit = [&](std::size_t at) {
    const auto low = static_cast<unsigned char>(bytes[at + (little ? 0 : 1)]);
    const auto high = static_cast<unsigned char>(bytes[at + (little ? 1 : 0)]);
    return static_cast<unsigned>(high) << 8U | low;
  };
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    unsigned code = unit(at);
    if (code >= 0xD800U && code < 0xDC00U && at + 3 < bytes.size()) {
      code = 0x10000U + ((code - 0xD800U) << 10U) + (unit(at + 2) - 0xDC00U);
      at += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

}  // namespace

RecordedText::RecordedText(const std::string& bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    text = from_utf16(bytes, bytes.front() == '\xFF');
  } else {
    text = csv_utf8(bytes);
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  }
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t stop = std::min(all.find_first_of("\r\n", at), all.size());
    lines.push_back(all.substr(at, stop - at));
    at = stop + (all.substr(stop).starts_with("\r\n") ? 2 : 1);
  }
}

bool recorded_number(std::string_view cell, char decimal, double& value) {
  std::array<char, 64> point;
  if (decimal == ',' && cell.size() <= point.size()) {
    if (cell.find('.') != std::string_view::npos) return false;
    std::ranges::replace_copy(cell, point.begin(), ',', '.');
    cell = {point.data(), cell.size()};
  }
  return parse_number(cell, value);
}

bool Recording::number(std::size_t row, std::size_t column, double& value) const {
  if (!of_numbers) return recorded_number(cell(row, column), decimal, value);
  value = numbers[row * columns.size() + column];
  return std::isfinite(value);
}

std::string Recording::written(std::size_t row, std::size_t column) const {
  double value = 0.0;
  if (of_numbers && number(row, column, value)) return fmt::format("{}", value);
  std::string text(cell(row, column));
  if (text.starts_with('+')) text.erase(0, 1);
  std::ranges::replace(text, ',', '.');
  return text;
}

RecordedColumn recorded_column(std::string_view field) {
  RecordedColumn column;
  field = trimmed(field);
  column.whole = field;
  const auto split_at = [&](std::size_t name_end, std::string_view unit) {
    column.name = trimmed(field.substr(0, name_end));
    column.unit = trimmed(unit);
  };
  constexpr std::pair<std::string_view, std::string_view> brackets[] = {
      {"[", "]"}, {"(", ")"}, {"（", "）"}, {"［", "］"}};
  for (const auto& [left, right] : brackets) {
    const std::size_t open = field.rfind(left);
    if (open == std::string_view::npos || open == 0 || !field.ends_with(right)) continue;
    const std::string_view inside =
        field.substr(open + left.size(), field.size() - right.size() - open - left.size());
    // "Angle (C)", "X (Radius)": more of the name.
    if (left != "[" && !is_unit_word(inside) && read_header_name(inside)) break;
    split_at(open, inside);
    return column;
  }
  if (constexpr std::string_view degree = "°"; field.ends_with(degree) && field != degree) {
    split_at(field.find_last_not_of(" /,_", field.size() - degree.size() - 1) + 1, degree);
    return column;
  }
  // "C / deg", "X in mm", "angle, rad", "time_s", "X_in"; X_M is not an X in metres.
  const std::size_t at = field.find_last_of(" /,_");
  if (at != std::string_view::npos && at > 0) {
    const std::string_view unit = field.substr(at + 1);
    const bool letter = unit.size() == 1 && field[at] == '_' && unit != "s";
    if (is_unit_word(unit) && !letter) {
      std::size_t end = field.find_last_not_of(" /,_", at);
      end = end == std::string_view::npos ? 0 : end + 1;
      if (field.substr(0, end).ends_with(" in")) end -= 3;
      split_at(end, unit);
      return column;
    }
  }
  column.name = field;
  return column;
}

std::vector<RecordedColumn> recorded_columns(const std::vector<std::string_view>& header) {
  std::vector<RecordedColumn> columns;
  for (const std::string_view field : header) columns.push_back(recorded_column(field));
  const auto in_metres = [](const RecordedColumn& column) {
    return column.unit.empty() && column.name.size() > 2 && column.name.ends_with("_m");
  };
  const auto has_suffix = [](const RecordedColumn& column) {
    return !column.unit.empty() && column.whole.ends_with("_" + column.unit);
  };
  if (std::ranges::count_if(columns, in_metres) < 2 && std::ranges::none_of(columns, has_suffix))
    return columns;
  for (RecordedColumn& column : columns) {
    if (!in_metres(column)) continue;
    column.unit = "m";
    column.name.resize(column.name.size() - 2);
  }
  return columns;
}

}  // namespace trueaxis
