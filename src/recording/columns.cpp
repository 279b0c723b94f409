// SPDX-License-Identifier: Apache-2.0
#include "recording/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/nearest_key.hpp"
#include "recording/column_names.hpp"

namespace trueaxis {
namespace {

/// "column 3 (Angle(°))", as messages speak of it.
std::string described(const Recording& recording, std::size_t column) {
  const std::string& whole = recording.columns[column].whole;
  return fmt::format("column {}{}", column + 1, whole.empty() ? "" : " (" + whole + ")");
}

/// The language that the header is in, where a name is of one alone: "Winkel", "Durchmesser".
std::string language_of(const Recording& recording) {
  for (const RecordedColumn& column : recording.columns)
    if (const auto named = role_of_name(column.name); named && !named->language.empty())
      return named->language;
  return "";
}

/// "mm" of "mm dia".
std::string without_dia(const std::string& unit) {
  return unit.ends_with(" dia") ? unit.substr(0, unit.size() - 4) : unit;
}

/// A unit that `--columns` gives must not contradict the file's own; a file may leave out `dia`.
void expect_unit_of_file(const Recording& recording, const TakenColumn& taken,
                         const std::string& said, std::vector<std::string>& unclear) {
  const auto stated =
      stream_unit(taken.role, recording.columns[taken.column].unit, language_of(recording));
  if (stated && *stated != said && *stated != without_dia(said))
    unclear.push_back(
        fmt::format("{} has the unit [{}] in the file, but [{}] in --columns: correct "
                    "one of them",
                    described(recording, taken.column), *stated, said));
}

/// The unit of a column as a stream writes it; adds to `unclear` what is not clear.
void take_unit(const Recording& recording, TakenColumn& taken,
               const std::optional<std::string>& said, std::vector<std::string>& unclear) {
  const std::string unit = said.value_or(recording.columns[taken.column].unit);
  taken.unit_typed = said.has_value();
  if (unit.empty()) {
    taken.unit = default_unit(taken.role);
    taken.unit_said = false;
    return;
  }
  if (const auto known = stream_unit(taken.role, unit, language_of(recording))) {
    taken.unit = without_dia(*known);
    if (said) expect_unit_of_file(recording, taken, *known, unclear);
    if (taken.unit.size() < known->size()) {
      if (taken.diameter == false)
        unclear.push_back(
            fmt::format("{} is a radius by its name, but its unit is that of a "
                        "diameter: correct one of them",
                        described(recording, taken.column)));
      taken.diameter = true;
    }
  } else {
    unclear.push_back(
        fmt::format("{} has the unit {}, which is not one of {}: convert the column, or write "
                    "its true unit after its number, as in {}={}[…]",
                    described(recording, taken.column), csv_quoted(unit),
                    taken.role == RecordedRole::c   ? "deg, rad and rev"
                    : taken.role == RecordedRole::t ? "s and ms"
                                                    : "mm, um, m and in",
                    word_of(taken.role), taken.column + 1));
  }
}

/// `Angle[rad]` is the column Angle in radians unless the header has a column Angle[rad].
ColumnsSaid::Item with_unit_split(const Recording& recording, ColumnsSaid::Item item) {
  const std::size_t open = item.column.rfind('[');
  if (item.unit || open == std::string::npos || item.column.back() != ']' ||
      find_column(recording, item.column))
    return item;
  const std::string name(trimmed(std::string_view(item.column).substr(0, open)));
  if (!find_column(recording, name)) return item;
  item.unit =
      trimmed(std::string_view(item.column).substr(open + 1, item.column.size() - open - 2));
  item.column = name;
  return item;
}

/// The column that an item names, without the unit that is written after it.
std::optional<std::size_t> column_said(const Recording& recording, const ColumnsSaid::Item& item) {
  return find_column(recording, with_unit_split(recording, item).column);
}

std::vector<TakenColumn> as_said(const Recording& recording, const ColumnsSaid& said,
                                 std::vector<std::string>& unclear) {
  std::vector<TakenColumn> taken;
  const bool face = std::ranges::any_of(
      said.items, [](const auto& item) { return role_of_word(item.role) == RecordedRole::face; });
  for (const ColumnsSaid::Item& as_written : said.items) {
    const ColumnsSaid::Item item = with_unit_split(recording, as_written);
    const auto role = role_of_word(item.role);
    const auto column = find_column(recording, item.column);
    if (!role) {
      unclear.push_back("--columns names '" + item.role +
                        "': it takes X, C, Z, Y, t, pass, setup, Z_M of a face, and decimal");
      continue;
    }
    if (!column) {
      std::vector<std::string> names;
      for (const RecordedColumn& one : recording.columns) names.push_back(one.name);
      const std::string array = item.column.substr(0, item.column.find('[')) + " (";
      const auto left = std::ranges::find_if(
          recording.left_out, [&](const std::string& one) { return one.starts_with(array); });
      if (left != recording.left_out.end()) {
        unclear.push_back(
            fmt::format("the array {} cannot be a column, as the longest has {} rows: write one "
                        "number per reading",
                        *left, recording.rows()));
        continue;
      }
      const std::string near = nearest_key(item.column, names);
      unclear.push_back(
          fmt::format("there is no column {}{} one of the header, or its number, 1 to {}",
                      csv_quoted(item.column),
                      near.empty() ? ": name" : ", did you mean " + csv_quoted(near) + "? Name",
                      recording.columns.size()));
      continue;
    }
    if (std::ranges::find(taken, *role, &TakenColumn::role) != taken.end())
      unclear.push_back(std::string("--columns names ") + word_of(*role) + " twice: keep one");
    TakenColumn one{*role, *column};
    const auto named = role_of_name(recording.columns[*column].name);
    if (*role == RecordedRole::x && named) one.diameter = named->diameter;
    if (face && *role == RecordedRole::z)
      unclear.emplace_back("a face has Z_M, C and X, but not Z: remove it from --columns");
    take_unit(recording, one, item.unit, unclear);
    taken.push_back(std::move(one));
  }
  return taken;
}

/// What a position of an axis that its name does not say becomes: an angle is C; one that may be
/// the only Z is asked for.
void take_vague(const Recording& recording, std::size_t k, std::vector<TakenColumn>& taken,
                std::vector<std::string>& unclear) {
  const auto has = [&](RecordedRole role) {
    return std::ranges::find(taken, role, &TakenColumn::role) != taken.end();
  };
  const bool turns =
      stream_unit(RecordedRole::c, recording.columns[k].unit, language_of(recording)).has_value();
  if (turns && !has(RecordedRole::c)) {
    taken.push_back({RecordedRole::c, k});
    take_unit(recording, taken.back(), std::nullopt, unclear);
  } else if (!turns && !has(RecordedRole::z) && !has(RecordedRole::face)) {
    unclear.push_back(described(recording, k) +
                      " does not say of which axis it is: say it in --columns, Z=" +
                      std::to_string(k + 1) + " for a position along the part");
  }
}

/// A column of lengths by a name that says nothing, such as that of another language: it may be Z
/// if it is not X.
bool is_unknown_length(const Recording& recording, std::size_t k) {
  const RecordedColumn& column = recording.columns[k];
  return column.is_number && !column.unit.empty() &&
         stream_unit(RecordedRole::z, column.unit, language_of(recording)).has_value();
}

std::vector<TakenColumn> as_named(const Recording& recording, std::vector<std::string>& unclear) {
  std::vector<TakenColumn> taken;
  std::vector<std::size_t> vague;
  for (std::size_t k = 0; k < recording.columns.size(); ++k) {
    const auto named = role_of_name(recording.columns[k].name);
    if (named ? named->vague : is_unknown_length(recording, k)) {
      vague.push_back(k);
      continue;
    }
    if (!named) continue;
    if (named->gauge) {
      unclear.push_back(described(recording, k) + " is of an indicator: say X=" +
                        std::to_string(k + 1) + ", --relative and --nominal-radius-mm");
      continue;
    }
    const auto other = std::ranges::find(taken, named->role, &TakenColumn::role);
    if (other != taken.end()) {
      unclear.push_back(fmt::format("{} and {} could both be {}: say which in --columns",
                                    described(recording, other->column), described(recording, k),
                                    word_of(named->role)));
      continue;
    }
    TakenColumn one{named->role, k};
    one.diameter = named->diameter;
    take_unit(recording, one, std::nullopt, unclear);
    taken.push_back(std::move(one));
  }
  const bool x_is_named =
      std::ranges::find(taken, RecordedRole::x, &TakenColumn::role) != taken.end();
  for (const std::size_t k : vague)
    if (x_is_named || role_of_name(recording.columns[k].name))
      take_vague(recording, k, taken, unclear);
  return taken;
}

}  // namespace

std::optional<std::size_t> find_column(const Recording& recording, const std::string& name) {
  for (std::size_t k = 0; k < recording.columns.size(); ++k)
    if (recording.columns[k].whole == name) return k;
  for (std::size_t k = 0; k < recording.columns.size(); ++k)
    if (!name.empty() && recording.columns[k].name == name) return k;
  const auto number = whole_number<std::size_t>(name).value_or(0);
  return number > 0 && number <= recording.columns.size() ? std::optional(number - 1)
                                                          : std::nullopt;
}

bool is_probe_log(const Recording& recording) {
  if (recording.columns.size() != 9 || recording.rows() == 0 || recording.of_numbers) return false;
  for (std::size_t k = 0; k < 9; ++k) {
    const std::string_view cell = recording.cell(0, k);
    if (!recording.columns[k].whole.empty() || cell.size() < 8 || cell[cell.size() - 7] != '.')
      return false;
  }
  return true;
}

ColumnsSaid read_columns_said(const std::string& text) {
  ColumnsSaid said;
  std::size_t begin = 0;
  int depth = 0;
  const auto take = [&](std::string_view item) {
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || trimmed(item.substr(equals + 1)).empty())
      throw InputError(
          "--columns",
          csv_quoted(item) + " is not a column: write it as in \"X=Diameter,C=Angle(°),Z=3[mm]\"");
    ColumnsSaid::Item one;
    one.role = trimmed(item.substr(0, equals));
    std::string_view column = trimmed(item.substr(equals + 1));
    if (one.role == "decimal") {
      if (column != "point" && column != "comma")
        throw InputError("--columns", csv_quoted(item) + ": it is decimal=point or decimal=comma");
      said.decimal = column == "point" ? '.' : ',';
      return;
    }
    const std::size_t open = column.find('[');
    if (open != std::string_view::npos && open > 0 && column.back() == ']' &&
        column.substr(0, open).find_first_not_of("0123456789") == std::string_view::npos) {
      one.unit = trimmed(column.substr(open + 1, column.size() - open - 2));
      column = column.substr(0, open);
    }
    one.column = column;
    said.items.push_back(std::move(one));
  };
  const std::string_view all = text;
  for (std::size_t i = 0; i <= all.size(); ++i) {
    if (i < all.size() && (all[i] == '[' || all[i] == '(')) ++depth;
    if (i < all.size() && (all[i] == ']' || all[i] == ')')) --depth;
    if (i < all.size() && (all[i] != ',' || depth > 0)) continue;
    take(trimmed(all.substr(begin, i - begin)));
    begin = i + 1;
  }
  return said;
}

namespace {

/// Three columns x, y, z, by name or without any.
bool are_points(const Recording& recording) {
  if (recording.columns.size() != 3) return false;
  constexpr RecordedRole roles[] = {RecordedRole::x, RecordedRole::y, RecordedRole::z};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto named = role_of_name(recording.columns[k].name);
    if (!recording.columns[k].whole.empty() && (!named || named->role != roles[k])) return false;
  }
  return true;
}

}  // namespace

namespace {

/// Whether lengths and angles have units in the file. TrueAxis' own names need none (stream.md).
bool states_units(const Recording& recording, const std::vector<TakenColumn>& taken) {
  return std::ranges::all_of(taken, [&](const TakenColumn& column) {
    const std::string& name = recording.columns[column.column].name;
    return column.role >= RecordedRole::t || (column.unit_said && name != "X_M" && name != "Z_M");
  });
}

/// A time without a unit among columns that state theirs is as often of milliseconds.
void ask_for_unit_of_time(const Recording& recording, const std::vector<TakenColumn>& taken,
                          std::vector<std::string>& unclear) {
  const auto t = std::ranges::find(taken, RecordedRole::t, &TakenColumn::role);
  if (t == taken.end() || t->unit_said || recording.of_numbers ||
      !recording.columns[t->column].is_number || !states_units(recording, taken))
    return;
  unclear.push_back(
      fmt::format("{} states no unit, as the other columns do: write t={}[s] or "
                  "t={}[ms] in --columns",
                  described(recording, t->column), t->column + 1, t->column + 1));
}

}  // namespace

std::optional<std::size_t> column_of_readings(const Recording& recording, const ColumnsSaid& said) {
  for (const RecordedRole role : {RecordedRole::face, RecordedRole::x}) {
    for (const ColumnsSaid::Item& item : said.items)
      if (role_of_word(item.role) == role) return column_said(recording, item);
    for (std::size_t k = 0; said.items.empty() && k < recording.columns.size(); ++k)
      if (const auto named = role_of_name(recording.columns[k].name); named && named->role == role)
        return k;
  }
  return {};
}

std::vector<TakenColumn> take_columns(const Recording& recording, const ColumnsSaid& said,
                                      std::vector<std::string>& unclear) {
  std::vector<TakenColumn> taken =
      said.items.empty() ? as_named(recording, unclear) : as_said(recording, said, unclear);
  ask_for_unit_of_time(recording, taken, unclear);
  const auto has = [&](RecordedRole role) {
    return std::ranges::find(taken, role, &TakenColumn::role) != taken.end();
  };
  for (const TakenColumn& column : taken)
    if (recording.of_numbers && !column.unit_said && !column.unit.empty())
      unclear.push_back(fmt::format(
          "{} ({}) has no unit, and a binary file shows none: write it after the number, {}={}[{}]",
          described(recording, column.column), word_of(column.role), word_of(column.role),
          column.column + 1, column.unit));
  if (!has(RecordedRole::x))
    unclear.emplace_back("no column is called X, Radius or Diameter: say which holds the readings");
  if (!has(RecordedRole::c))
    unclear.emplace_back("no column is called C or Angle: say which holds the spindle angle");
  if (!has(RecordedRole::c) && said.items.empty() && are_points(recording))
    unclear.emplace_back(
        "points x y z without a spindle angle are read by trueaxis fit --points FILE --element "
        "cylinder, and by trueaxis form FILE --element cylinder");
  return taken;
}

std::string columns_suggested(const Recording& recording) {
  if (is_probe_log(recording)) return "X=1[mm],C=6[deg],Z=3[mm]";
  using enum RecordedRole;
  const auto named_so = [&](RecordedRole role) {
    return std::ranges::any_of(recording.columns, [&](const RecordedColumn& column) {
      const auto named = role_of_name(column.name);
      return named && named->role == role && !named->vague;
    });
  };
  // A stream needs the first three; the others are there if the header names them.
  std::vector<std::pair<RecordedRole, std::string>> items{{x, ""}, {c, ""}, {z, ""}};
  if (named_so(face)) items = {{face, ""}, {c, ""}, {x, ""}};
  for (const RecordedRole role : {t, pass, setup})
    if (named_so(role)) items.emplace_back(role, "");
  const bool states_some_unit = std::ranges::any_of(
      recording.columns, [](const auto& column) { return !column.unit.empty(); });
  for (const bool vague : {false, true})
    for (std::size_t k = 0; k < recording.columns.size(); ++k) {
      const auto named = role_of_name(recording.columns[k].name);
      const bool unknown = !named && is_unknown_length(recording, k);
      if ((!named && !unknown) || (unknown || named->vague) != vague) continue;
      const std::string& unit = recording.columns[k].unit;
      const RecordedRole role = unknown ? z : vague && stream_unit(c, unit, "*") ? c : named->role;
      const auto item = std::ranges::find(items, role, [](const auto& one) { return one.first; });
      if (item == items.end() || !item->second.empty()) continue;
      const bool said = stream_unit(role, unit, language_of(recording)).has_value();
      const auto meant = stream_unit(role, unit, "*");  // "Grad", where it is a degree
      item->second = std::to_string(k + 1);
      if (unit.empty() && recording.of_numbers && *default_unit(role) != '\0')
        item->second += fmt::format("[{}]", default_unit(role));
      else if (!unit.empty() && !said)
        item->second += "[" + meant.value_or("…") + "]";
      else if (unit.empty() && role == t && states_some_unit)
        item->second += "[…]";
    }
  std::string text;
  for (const auto& [role, column] : items)
    text += fmt::format("{}{}={}", text.empty() ? "" : ",", word_of(role),
                        column.empty() ? "…" : column);
  return text;
}

}  // namespace trueaxis
