// SPDX-License-Identifier: Apache-2.0
#include "calibrate/files/measurement_header.hpp"

#include <algorithm>
#include <array>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/units.hpp"

namespace trueaxis {
namespace {

using Role = MeasurementRole;

/// A column that a file may have.
struct Known {
  std::string name;
  Role role;
  std::size_t index;
  UnitKind quantity;
  bool needed;
};

UnitKind of_axis(AxisName axis) { return is_rotary(axis) ? UnitKind::angle : UnitKind::length; }

std::vector<Known> known_columns(const MeasurementMetadata& metadata, const Machine& machine) {
  const MeasurementKind kind = *metadata.kind;
  if (kind == MeasurementKind::axis) {
    const UnitKind quantity = of_axis(metadata.axis.value_or(AxisName::X));
    return {{"command", Role::command, 0, quantity, true},
            {"actual", Role::actual, 0, quantity, false},
            {"error", Role::error, 0, quantity, false},
            {"t", Role::time, 0, UnitKind::time, false}};
  }
  const bool array = kind == MeasurementKind::array;
  std::vector<Known> known{{"setup", Role::setup, 0, UnitKind::count, !array},
                           {"ball", Role::ball, 0, UnitKind::count, true}};
  for (const MachineAxis& axis : machine.axes)  // an array's rotary axes are at 0 unless stated
    known.push_back({std::string(1, letter_of(axis.name)), Role::axis, index_of(axis.name),
                     of_axis(axis.name), !array || !is_rotary(axis.name)});
  if (kind == MeasurementKind::ball)
    for (std::size_t i = 0; i < 3; ++i)
      known.push_back({std::string("d") + "XYZ"[i], Role::deviation, i, UnitKind::length, true});
  if (kind == MeasurementKind::bar) known.push_back({"L", Role::length, 0, UnitKind::length, true});
  if (array) known.push_back({"s", Role::along, 0, UnitKind::length, true});
  known.push_back({"tool_length", Role::tool_length, 0, UnitKind::length, false});
  known.push_back({"t", Role::time, 0, UnitKind::time, false});
  return known;
}

std::string names(const std::vector<Known>& known) { return word_list(known, " ", &Known::name); }

/// What is wrong with the header's field, "" where nothing is; `column` is then filled.
std::string take(std::string_view field, const std::vector<Known>& known,
                 MeasurementColumn& column) {
  const std::size_t bracket = field.find('[');
  const std::string name(trimmed(field.substr(0, bracket)));
  const auto found = std::ranges::find(known, name, &Known::name);
  if (found == known.end()) {
    const bool axis =
        name.size() == 1 && std::string_view("XYZABC").find(name) != std::string::npos;
    return axis ? "the machine has no axis " + name + ": remove the column"
                : csv_quoted(name) + " is not a column of this kind: the columns are " +
                      names(known);
  }
  column.role = found->role;
  column.index = found->index;
  column.name = name;
  const bool unit_there = bracket != std::string_view::npos;
  if (found->quantity == UnitKind::count)
    return unit_there ? name + " is a number without a unit: write " + name : "";
  const std::string give =
      std::string(": write it in brackets, one of ") + known_units(found->quantity);
  if (!unit_there) return name + " has no unit" + give;
  const std::string_view unit = trimmed(field.substr(bracket + 1, field.find(']') - bracket - 1));
  const auto factor = find_unit(found->quantity, unit);
  if (!factor || field.back() != ']') return csv_quoted(unit) + " is not a unit of " + name + give;
  column.factor = factor->factor;
  return "";
}

}  // namespace

std::vector<MeasurementColumn> measurement_columns(std::string_view line, std::size_t number,
                                                   const MeasurementMetadata& metadata,
                                                   const Machine& machine,
                                                   CsvDiagnostics& diagnostics) {
  const std::vector<Known> known = known_columns(metadata, machine);
  const auto fields = csv_fields(line, ',');
  std::vector<MeasurementColumn> columns;
  bool good = true;
  const auto wrong = [&](std::size_t column, std::string message) {
    diagnostics.add(number, column, std::move(message));
    good = false;
  };
  for (const std::string_view field : fields) {
    MeasurementColumn column;
    std::string why = take(field, known, column);
    if (why.empty() &&
        std::ranges::find(columns, column.name, &MeasurementColumn::name) != columns.end())
      why = column.name + " is given twice: keep one";
    if (!why.empty()) wrong(csv_character(line, field), std::move(why));
    columns.push_back(std::move(column));
  }
  for (const Known& one : known) {
    if (one.needed &&
        std::ranges::find(columns, one.name, &MeasurementColumn::name) == columns.end())
      wrong(0, "has no column " + one.name + ": the columns are " + names(known));
  }
  if (*metadata.kind == MeasurementKind::axis) {
    const auto has = [&](Role role) {
      return std::ranges::find(columns, role, &MeasurementColumn::role) != columns.end();
    };
    if (has(Role::actual) && has(Role::error))
      wrong(0, "has the columns actual and error: keep one of them");
    else if (!has(Role::actual) && !has(Role::error))
      wrong(0, "has neither a column actual nor a column error (actual less command): add one");
  }
  if (!good) columns.clear();
  return columns;
}

namespace {

constexpr std::array keys{"kind", "noise", "axis", "gear_ratio"};
constexpr std::array kinds{MeasurementKind::ball, MeasurementKind::bar, MeasurementKind::array,
                           MeasurementKind::axis};

std::string take_kind(std::string_view value, MeasurementMetadata& metadata) {
  for (const MeasurementKind kind : kinds)
    if (value == to_string(kind)) metadata.kind = kind;
  return metadata.kind ? "" : csv_quoted(value) + " is not a kind: write ball, bar, array or axis";
}

std::string take_noise(std::string_view value, MeasurementMetadata& metadata) {
  for (const UnitKind quantity : {UnitKind::length, UnitKind::angle}) {
    const auto noise = quantity_in(value, quantity);
    if (!noise) continue;
    if (!(*noise > 0.0)) return "noise must be more than 0: the standard deviation of a read-out";
    metadata.noise = noise;
    metadata.noise_is_angle = quantity == UnitKind::angle;
    return "";
  }
  return csv_quoted(value) + " is not a noise: write a number and its unit, such as 1 um";
}

std::string take_axis(std::string_view value, MeasurementMetadata& metadata) {
  const std::size_t at = std::string_view("XYZABC").find(value);
  if (value.size() != 1 || at == std::string_view::npos)
    return csv_quoted(value) + " is not an axis: write one of X Y Z A B C";
  metadata.axis = static_cast<AxisName>(at);
  return "";
}

std::string take_gear_ratio(std::string_view value, MeasurementMetadata& metadata) {
  const auto ratio = whole_number<int>(value);
  constexpr int most = 10000;
  if (!ratio || *ratio < 2 || *ratio > most)
    return csv_quoted(value) +
           " is not a gear ratio: write how often the gear turns per revolution of the axis, 2 to "
           "10000";
  metadata.gear_ratio = ratio;
  return "";
}

std::string take_value(std::string_view key, std::string_view value,
                       MeasurementMetadata& metadata) {
  return key == "kind"    ? take_kind(value, metadata)
         : key == "noise" ? take_noise(value, metadata)
         : key == "axis"  ? take_axis(value, metadata)
                          : take_gear_ratio(value, metadata);
}

/// The known key that `word` was meant to be, or nothing: a letter off, or two with a value that
/// only the key has.
const char* meant(std::string_view word, std::string_view value) {
  for (const char* key : keys) {
    const std::size_t distance = word == key ? 0 : edit_distance(lower_case(word), key);
    MeasurementMetadata tried;
    if (word != key && (distance <= 1 || (distance == 2 && take_value(key, value, tried).empty())))
      return key;
  }
  return nullptr;
}

}  // namespace

void take_measurement_comment(std::string_view line, std::size_t number,
                              MeasurementMetadata& metadata, CsvDiagnostics& diagnostics) {
  const std::size_t hash = line.find('#');
  std::string_view text = trimmed(line.substr(hash + 1));
  if (text.starts_with('#')) return;
  const std::size_t colon = text.find_first_of(":=");
  if (colon == std::string_view::npos) return;
  const std::string key(trimmed(text.substr(0, colon)));
  const std::string_view value = trimmed(text.substr(colon + 1));
  const std::size_t column =
      csv_character(line, static_cast<std::size_t>(text.data() - line.data()));
  if (const char* const known = meant(key, value)) {
    diagnostics.add(number, column, csv_quoted(key) + " is not a key: did you mean " + known + "?");
    return;
  }
  if (std::ranges::find(keys, key) == keys.end()) return;
  std::string wrong;
  if (text[colon] == '=')
    wrong = "write `# " + key + ": …` with a colon";
  else if (!metadata.lines.try_emplace(key, number).second)
    wrong = key + " is given twice: keep one";
  else
    wrong = take_value(key, value, metadata);
  if (!wrong.empty()) diagnostics.add(number, column, std::move(wrong));
}

}  // namespace trueaxis
