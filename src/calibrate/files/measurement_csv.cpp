// SPDX-License-Identifier: Apache-2.0
#include "calibrate/files/measurement_csv.hpp"

#include <algorithm>
#include <cmath>

#include "base/angle.hpp"
#include "base/diagnostics.hpp"
#include "base/number.hpp"
#include "calibrate/files/measurement_header.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"

namespace trueaxis {
namespace {

using Role = MeasurementRole;
constexpr std::size_t most_listed = 50;

/// A finite number below 1e9, whole where it counts; else what is wrong.
std::string trouble_of(const MeasurementColumn& column, std::string_view text, double& value) {
  if (text.empty()) return column.name + " is empty: write a number or remove the row";
  std::errc error{};
  const char* const end = text.data() + text.size();
  if (read_number(text.data(), end, value, error) != end)
    return column.name + ": " + csv_quoted(text) + " is not a number";
  if (error != std::errc{} || !(std::abs(value) < 1e9))
    return column.name + ": " + csv_quoted(text) +
           " is not finite or out of range: remove the row or measure it again";
  const bool counts = column.role == Role::setup || column.role == Role::ball;
  if (counts && value != std::floor(value))
    return column.name + ": " + csv_quoted(text) + " is not a whole number: number them 1, 2, 3";
  return "";
}

class Rows {
 public:
  Rows(MachineMeasurement& out, CsvDiagnostics& diagnostics)
      : out_(out), diagnostics_(diagnostics) {}

  std::vector<MeasurementColumn> columns;

  void begin(std::vector<MeasurementColumn> found) {
    columns = std::move(found);
    of_errors_ = std::ranges::find(columns, Role::error, &MeasurementColumn::role) != columns.end();
  }

  void row(std::string_view line, std::size_t number) {
    csv_split(line, ',', fields_);
    if (fields_.size() != columns.size()) {
      diagnostics_.add(number, 0,
                       "the row has " + std::to_string(fields_.size()) +
                           " fields, the header names " + std::to_string(columns.size()) +
                           ": write one field per column");
      return;
    }
    begin_row();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      double value = 0.0;
      std::string why = trouble_of(columns[k], fields_[k], value);
      value *= columns[k].factor;
      if (why.empty()) why = put(columns[k], value);
      if (why.empty()) continue;
      diagnostics_.add(number, csv_character(line, fields_[k]), std::move(why));
    }
    if (of_errors_ && out_.actual.size() == out_.rows())
      out_.actual.back() += out_.axes.back()[index_of(*out_.axis)];
  }

  /// Whether commands that are read as degrees are a turn of something else.
  bool covers_turn_in_radians() const {
    const auto command = std::ranges::find(columns, Role::command, &MeasurementColumn::role);
    if (command == columns.end() || !is_rotary(*out_.axis) || command->factor != rad_per_deg)
      return false;
    const std::size_t k = index_of(*out_.axis);
    const auto [low, high] =
        std::ranges::minmax(out_.axes, {}, [k](const AxisPositions& at) { return at[k]; });
    return is_turn_in_radians((high[k] - low[k]) / rad_per_deg);
  }

 private:
  void begin_row() {
    out_.axes.emplace_back(AxisPositions{});
    out_.setup.push_back(1);
    out_.ball.push_back(1);
    if (out_.kind == MeasurementKind::ball) out_.deviation_mm.emplace_back(Vector3{});
  }

  std::string put(const MeasurementColumn& column, double value) {
    switch (column.role) {
      case Role::setup:
        out_.setup.back() = static_cast<int>(value);
        break;
      case Role::ball:
        out_.ball.back() = static_cast<int>(value);
        break;
      case Role::axis:
        out_.axes.back()[column.index] = value;
        break;
      case Role::deviation:
        out_.deviation_mm.back()[column.index] = value;
        break;
      case Role::command:
        out_.axes.back()[index_of(*out_.axis)] = value;
        break;
      case Role::actual:
      case Role::error:
        out_.actual.push_back(value);
        break;
      case Role::length:
        if (!(value > 0.0)) return "L must be more than 0: the length from ball to tip";
        out_.length_mm.push_back(value);
        break;
      case Role::along:
        out_.along_mm.push_back(value);
        break;
      case Role::tool_length:
        if (value < 0.0) return "tool_length must not be negative";
        out_.tool_length_mm.push_back(value);
        break;
      case Role::time:
        if (!out_.time_s.empty() && value < out_.time_s.back())
          return "t falls: sort the rows by time";
        out_.time_s.push_back(value);
        break;
    }
    return "";
  }

  MachineMeasurement& out_;
  CsvDiagnostics& diagnostics_;
  std::vector<std::string_view> fields_;
  bool of_errors_ = false;
};

/// Whether the lines before the header are enough to read it.
bool take_metadata(const MeasurementMetadata& metadata, const Machine& machine, std::size_t number,
                   MachineMeasurement& out, CsvDiagnostics& diagnostics) {
  const auto wrong = [&](const char* key, const std::string& why) {
    const auto line = metadata.lines.find(key);
    diagnostics.add(line == metadata.lines.end() ? number : line->second, 0, why);
  };
  if (!metadata.kind) {
    if (!metadata.lines.contains("kind"))
      wrong("kind",
            "does not state its kind before the header: write `# kind: ball` (bar, array, axis)");
    return false;
  }
  out.kind = *metadata.kind;
  const bool of_axis = out.kind == MeasurementKind::array || out.kind == MeasurementKind::axis;
  out.axis = metadata.axis;
  out.gear_ratio = metadata.gear_ratio;
  if (metadata.gear_ratio &&
      !(out.kind == MeasurementKind::axis && is_rotary(metadata.axis.value_or(AxisName::C))))
    wrong("gear_ratio", "gear_ratio belongs only to kind axis with a rotary axis: remove it");
  out.noise_mm = metadata.noise;
  if (!of_axis && metadata.axis)
    wrong("axis", "axis belongs only to kinds array and axis: remove it");
  if (of_axis && !metadata.axis && !metadata.lines.contains("axis"))
    wrong("axis", "does not state its axis before the header: write `# axis: X`");
  if (out.axis && machine.find(*out.axis) == nullptr)
    wrong("axis", std::string("the machine has no axis ") + letter_of(*out.axis));
  if (out.kind == MeasurementKind::array && out.axis && is_rotary(*out.axis))
    wrong("axis", "an array of balls lies along a linear axis");
  const bool angle = out.kind == MeasurementKind::axis && out.axis && is_rotary(*out.axis);
  if (metadata.noise && metadata.noise_is_angle != angle)
    wrong("noise", angle ? "noise of a rotary axis is an angle" : "noise is a length");
  return !of_axis || metadata.axis.has_value();
}

/// Rows that a file has twice, as a block after the first or each after itself: noise writes no row
/// again. Visits there and back come in the other order.
bool is_doubled(std::span<const std::string_view> rows) {
  constexpr std::size_t fewest = 8;
  const std::size_t half = rows.size() / 2;
  if (rows.size() < fewest || rows.size() % 2 != 0) return false;
  if (std::ranges::equal(rows.first(half), rows.last(half))) return true;
  for (std::size_t i = 0; i < half; ++i)
    if (rows[2 * i] != rows[2 * i + 1]) return false;
  return true;
}

}  // namespace

MachineMeasurement read_measurement_csv(const std::string& path, const Machine& machine) {
  const std::string text = read_file(path);
  MachineMeasurement out;
  out.source = path;
  out.input_hash = content_hash(text);
  CsvDiagnostics diagnostics(path, most_listed);
  MeasurementMetadata metadata;
  Rows rows(out, diagnostics);
  bool header = false;
  std::size_t last = 0;
  std::vector<std::string_view> lines;
  for_each_line(text, [&](std::string_view line, std::size_t number) {
    if (header && rows.columns.empty()) return;
    last = number;
    const std::string_view content = csv_without_comment(line);
    if (trimmed(content).empty()) {
      if (content.size() < line.size() && !header)
        take_measurement_comment(line, number, metadata, diagnostics);
      return;
    }
    if (!header) {
      header = true;
      if (take_metadata(metadata, machine, number, out, diagnostics))
        rows.begin(measurement_columns(content, number, metadata, machine, diagnostics));
    } else {
      rows.row(content, number);
      lines.push_back(trimmed(content));
    }
  });
  if (!header)
    diagnostics.add(0, 0, "has no header and no rows");
  else if (!diagnostics.any() && out.rows() == 0)
    diagnostics.add(last, 0, "has no rows");
  else if (is_doubled(lines))
    diagnostics.add(0, 0, "holds every row twice: keep each row once");
  else if (out.kind == MeasurementKind::axis && rows.covers_turn_in_radians())
    diagnostics.add(last, 0,
                    "the commands cover one revolution in rad, and the header has deg: write "
                    "command[rad] and the unit of the other column");
  diagnostics.throw_if_any();
  return out;
}

std::vector<MachineMeasurement> read_measurements(const std::vector<std::string>& paths,
                                                  const Machine& machine) {
  auto all = read_each(
      paths, [&](const std::string& path) { return read_measurement_csv(path, machine); });
  std::vector<Diagnostic> wrong;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (all[i].input_hash == all[k].input_hash) {
        wrong.push_back({paths[i], 0, 0,
                         paths[i] == paths[k] ? "is named twice: name it once"
                                              : "holds the rows of " + paths[k] +
                                                    " again: measure twice, or name it once"});
        break;
      }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return all;
}

}  // namespace trueaxis
