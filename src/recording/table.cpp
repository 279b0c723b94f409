// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "base/counted.hpp"
#include "base/text.hpp"
#include "format/csv_text.hpp"
#include "format/units.hpp"
#include "recording/column_names.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

/// How the fields of a table are told apart and how its numbers are written.
struct Layout {
  char separator = ',', decimal = '.';
  double numbers = 0.0;    ///< part of the fields of its rows that are numbers
  std::size_t rows = 0;    ///< lines that look like rows, of those tried
  std::size_t fields = 0;  ///< that most of them have
};

void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  csv_split(line, separator, fields, CsvKeep::quotes);
}

bool is_number(std::string_view field, char decimal) {
  double value = 0.0;
  return recorded_number(field, decimal, value);
}

std::size_t numbers_in(const std::vector<std::string_view>& fields, char decimal) {
  return static_cast<std::size_t>(std::ranges::count_if(
      fields, [&](std::string_view field) { return is_number(field, decimal); }));
}

/// In lines of two numbers or more: how many fields most have, and how many of these are numbers.
Layout tried(const RecordedText& text, std::size_t skip, Layout layout) {
  constexpr std::size_t most_lines = 4000;
  std::map<std::size_t, std::size_t> of_count;
  std::vector<std::string_view> fields;
  std::size_t numbers = 0, all = 0;
  for (std::size_t i = skip; i < text.lines.size() && layout.rows < most_lines; ++i) {
    split(text.lines[i], layout.separator, fields);
    const std::size_t found = numbers_in(fields, layout.decimal);
    if (found < 2) continue;
    const auto filled = std::ranges::count_if(fields, [](auto field) { return !field.empty(); });
    ++layout.rows;
    ++of_count[fields.size()];
    numbers += found;
    all += static_cast<std::size_t>(filled);
  }
  if (all == 0) return layout;
  layout.numbers = static_cast<double>(numbers) / static_cast<double>(all);
  layout.fields =
      std::ranges::max_element(of_count, {}, [](const auto& x) { return x.second; })->first;
  return layout;
}

/// The layout in which most lines are rows and most of their fields numbers.
std::optional<Layout> best_layout(const RecordedText& text, std::size_t skip,
                                  std::optional<char> said) {
  Layout best;
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    for (const char decimal : {'.', ','}) {
      if (said.value_or(decimal) != decimal) continue;
      if (decimal == separator && text.text.find('"') == std::string::npos) continue;
      const Layout layout = tried(text, skip, {separator, decimal});
      const auto worth = [](const Layout& l) { return l.numbers * static_cast<double>(l.rows); };
      if (worth(layout) > 1.0001 * worth(best)) best = layout;
    }
  }
  return best.rows < 2 ? std::nullopt : std::optional(best);
}

bool is_comment(std::string_view line) { return trimmed(line).starts_with('#'); }

/// A row of units below the names: every field is a unit or empty, none a number.
bool is_unit_row(const std::vector<std::string_view>& fields) {
  constexpr std::string_view others[] = {"", "-", "min", "1", "mm dia"};
  bool any = false;
  for (std::string_view field : fields) {
    if (field.size() > 2 && (field.front() == '[' || field.front() == '('))
      field = trimmed(field.substr(1, field.size() - 2));
    if (!is_unit_word(field) && std::ranges::find(others, field) == std::end(others)) return false;
    any = any || !field.empty();
  }
  return any;
}

/// Names and units of the columns from the lines above the first row.
void read_names(const RecordedText& text, std::size_t skip, std::size_t first, const Layout& layout,
                Recording& out) {
  std::vector<std::string_view> fields, units;
  std::optional<std::size_t> names;
  for (std::size_t i = first; i-- > skip && !names;) {
    if (trimmed(text.lines[i]).empty() || is_comment(text.lines[i])) continue;
    split(text.lines[i], layout.separator, fields);
    if (units.empty() && is_unit_row(fields)) {
      units = fields;
      continue;
    }
    const auto named = std::ranges::count_if(fields, [](auto field) { return !field.empty(); });
    if (named < 2) break;  // a title
    names = i;
  }
  if (names) {
    split(text.lines[*names], layout.separator, fields);
    out.columns = recorded_columns(fields);
  }
  out.columns.resize(std::max(layout.fields, out.columns.size()));
  for (std::size_t k = 0; k < std::min(units.size(), out.columns.size()); ++k) {
    std::string_view unit = units[k];
    if (unit.size() > 2 && (unit.front() == '[' || unit.front() == '('))
      unit = trimmed(unit.substr(1, unit.size() - 2));
    if (out.columns[k].unit.empty()) out.columns[k].unit = unit;
    if (!unit.empty() && unit != out.columns[k].unit)
      out.unclear.push_back(csv_quoted(out.columns[k].whole) + " has the unit " + csv_quoted(unit) +
                            " below it: correct one of them");
  }
  std::string titles;
  for (std::size_t i = skip; i < names.value_or(first); ++i) {
    const std::string_view line = trimmed(text.lines[i]);
    if (is_comment(line)) {
      take_comment(text.lines[i], i + 1, out);
    } else if (line.find_first_not_of(";,\t |\"") != std::string_view::npos &&
               !line.starts_with("sep=")) {
      add_to_list(titles, csv_quoted(line));
      take_title(line, out);
    }
  }
  if (!titles.empty()) out.notes.push_back("lines above the table are passed over: " + titles);
}

/// Columns without a name and without a number in any row: separators that end a line.
void drop_empty_columns(Recording& out) {
  std::size_t used = out.columns.size();
  const auto empty = [&](std::size_t k) {
    if (!out.columns[k].whole.empty()) return false;
    for (std::size_t i = 0; i < out.rows(); ++i)
      if (!out.cell(i, k).empty()) return false;
    return true;
  };
  while (used > 1 && empty(used - 1)) --used;
  if (used == out.columns.size()) return;
  std::vector<std::string_view> kept;
  kept.reserve(out.rows() * used);
  for (std::size_t i = 0; i < out.rows(); ++i)
    for (std::size_t k = 0; k < used; ++k) kept.push_back(out.cell(i, k));
  out.cells = std::move(kept);
  out.columns.resize(used);
}

enum class HeaderAgain { no, same, another };

/// Whether a row has names in the place of numbers, as where a logger begins anew.
HeaderAgain header_again(const std::vector<std::string_view>& fields, char decimal,
                         const Recording& out) {
  if (numbers_in(fields, decimal) > 0) return HeaderAgain::no;
  std::size_t same = 0, named = 0, filled = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::string_view field = trimmed(fields[k]);
    filled += field.empty() ? 0 : 1;
    same += !field.empty() && k < out.columns.size() && field == out.columns[k].whole ? 1 : 0;
    named += role_of_name(recorded_column(field).name) ? 1 : 0;
  }
  return filled > 1 && same == filled ? HeaderAgain::same
         : named > 1                  ? HeaderAgain::another
                                      : HeaderAgain::no;
}

/// Whether every decimal mark of a table may also separate thousands: after one to three digits,
/// the first of which is not a zero, and before exactly three.
bool may_part_thousands(const Recording& recording) {
  bool any = false;
  for (const std::string_view cell : recording.cells) {
    const std::size_t at = cell.find(recording.decimal);
    if (at == std::string_view::npos || !is_number(cell, recording.decimal)) continue;
    const std::size_t first = cell.find_first_of("0123456789");
    if (at < first + 1 || at > first + 3 || cell[first] == '0' || cell.size() != at + 4)
      return false;
    any = true;
  }
  return any;
}

const char* name_of(char separator) {
  return separator == ';'    ? "semicolons"
         : separator == '\t' ? "tabs"
         : separator == ','  ? "commas"
         : separator == '|'  ? "bars"
                             : "blanks";
}

}  // namespace

bool read_table(const RecordedText& text, std::size_t skip, std::optional<char> decimal,
                Recording& out) {
  skip = std::min(skip, text.lines.size());
  const std::optional<Layout> layout = best_layout(text, skip, decimal);
  if (!layout) return false;
  std::vector<std::string_view> fields;
  const auto is_row = [&](std::size_t i) {
    if (is_comment(text.lines[i])) return false;
    split(text.lines[i], layout->separator, fields);
    return numbers_in(fields, layout->decimal) >= 2;
  };
  std::size_t first = skip;
  while (first < text.lines.size() && !is_row(first)) ++first;
  read_names(text, skip, first, *layout, out);
  const std::size_t columns = out.columns.size();
  std::size_t missing = 0, repeated = 0;
  bool after_gap = false;
  for (std::size_t i = first; i < text.lines.size(); ++i) {
    const std::string_view line = trimmed(text.lines[i]);
    if (line.find_first_not_of(";,\t |\"") == std::string_view::npos) {
      after_gap = true;
      continue;
    }
    split(text.lines[i], layout->separator, fields);
    // "#DIV/0!;12,5;…" is a row of a spreadsheet, no comment.
    if (is_comment(line) && (layout->separator == ' ' || fields.size() < columns)) {
      take_comment(text.lines[i], i + 1, out);
      continue;
    }
    if (const HeaderAgain again = header_again(fields, layout->decimal, out);
        again != HeaderAgain::no) {
      if (again == HeaderAgain::another)
        out.wrong.push_back({"", i + 1, 1,
                             "is another header than that of the table: cut the file here, or "
                             "remove the line"});
      else
        ++repeated;
      continue;
    }
    if (line == "overrun") {
      ++missing;
      continue;
    }
    if (after_gap && !out.lines.empty())
      out.notes.push_back(fmt::format("the table goes on after empty lines, in line {}", i + 1));
    after_gap = false;
    if (std::any_of(fields.begin() + static_cast<std::ptrdiff_t>(std::min(columns, fields.size())),
                    fields.end(), [](std::string_view field) { return !field.empty(); }))
      out.wrong.push_back(
          {"", i + 1, csv_character(text.lines[i], fields[columns]),
           fmt::format("the row has {} fields, the table {} columns: write one field "
                       "per column",
                       fields.size(), columns)});
    fields.resize(columns);
    out.lines.push_back(i + 1);
    out.cells.insert(out.cells.end(), fields.begin(), fields.end());
  }
  if (repeated > 0)
    out.notes.push_back("the header is there again " + counted(repeated, "time", "times") +
                        ", and passed over");
  if (missing > 0)
    out.notes.push_back(
        fmt::format("the sampler says {} times that it lost readings (overrun)", missing));
  out.decimal = layout->decimal;
  drop_empty_columns(out);
  for (std::size_t k = 0; k < out.columns.size(); ++k) {
    std::size_t numbers = 0;
    for (std::size_t i = 0; i < out.rows(); ++i)
      numbers += is_number(out.cell(i, k), out.decimal) ? 1 : 0;
    out.columns[k].is_number = 2 * numbers > out.rows();
  }
  out.in_thousands =
      !decimal && layout->separator != ',' && layout->separator != ' ' && may_part_thousands(out);
  out.producer = std::string("a table with ") + name_of(layout->separator) +
                 (layout->decimal == ',' ? " and decimal commas" : "");
  return true;
}

}  // namespace trueaxis
