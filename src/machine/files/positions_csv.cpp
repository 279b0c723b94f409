// SPDX-License-Identifier: Apache-2.0
#include "machine/files/positions_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "format/units.hpp"
#include "machine/files/number_table.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

struct Column {
  std::size_t axis = 0;
  double factor = 1.0;
};

std::string usual(const MachineAxis& axis) {
  return std::string(1, letter_of(axis.name)) + (is_rotary(axis.name) ? "[deg]" : "[mm]");
}

std::vector<Column> axis_columns(const NumberTable& table, const Machine& machine,
                                 const std::function<void(std::string)>& complain) {
  std::vector<Column> columns;
  std::array<bool, axis_count> there{};
  for (const std::string& text : table.header) {
    const auto [name, unit] = name_with_unit(text);
    const auto axis = axis_of(name);
    if (!axis || machine.find(*axis) == nullptr) {
      complain('"' + text + "\" is not an axis of the machine");
      columns.push_back({});
      continue;
    }
    const auto known =
        find_unit(is_rotary(*axis) ? UnitKind::angle : UnitKind::length, unit.value_or(""));
    if (!known) complain('"' + text + "\" needs its unit: write " + usual(*machine.find(*axis)));
    if (there[index_of(*axis)]) complain('"' + text + "\" is given twice");
    there[index_of(*axis)] = true;
    columns.push_back({index_of(*axis), known ? known->factor : 1.0});
  }
  for (const MachineAxis& axis : machine.axes)
    if (!there[index_of(axis.name)])
      complain("has no column " + usual(axis) + ": add it, 0 where the axis stays at 0");
  return columns;
}

void append(std::string& text, double value, char behind) {
  fmt::format_to(std::back_inserter(text), "{:.17g}{}", value + 0.0, behind);  // no -0
}

}  // namespace

std::vector<AxisPositions> read_positions_csv(const std::string& path, const Machine& machine) {
  std::vector<Diagnostic> wrong;
  const NumberTable table = read_number_table(path, wrong);
  std::vector<Column> columns;
  if (!table.header.empty())
    columns = axis_columns(table, machine, [&](std::string message) {
      wrong.push_back({path, table.header_line, 0, std::move(message)});
    });
  if (!wrong.empty()) throw InputError(std::move(wrong));
  std::vector<AxisPositions> positions;
  for (const NumberTable::Row& row : table.rows) {
    AxisPositions& axes = positions.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i)
      axes[columns[i].axis] = row.values[i] * columns[i].factor;
  }
  return positions;
}

std::vector<ToolTarget> read_tool_targets_csv(const std::string& path) {
  static constexpr std::string_view names[] = {"x", "y", "z", "i", "j", "k"};
  std::vector<Diagnostic> wrong;
  const NumberTable table = read_number_table(path, wrong);
  const auto complain = [&](std::size_t line, std::string message) {
    wrong.push_back({path, line, 0, std::move(message)});
  };
  std::array<std::size_t, 6> at{};
  at.fill(table.header.size());
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    const auto [name, unit] = name_with_unit(table.header[i]);
    const auto known = static_cast<std::size_t>(std::ranges::find(names, name) - names);
    const bool unit_known = !unit || (known < 3 && unit == "mm");
    if (name == "twist") continue;
    if (known == 6 || !unit_known || at[known] != table.header.size())
      complain(table.header_line,
               '"' + table.header[i] + "\" must be one of x,y,z,i,j,k (mm), each once");
    else
      at[known] = i;
  }
  for (std::size_t n = 0; n < 6 && !table.header.empty(); ++n)
    if (at[n] == table.header.size())
      complain(table.header_line, "has no column " + std::string(names[n]));
  std::vector<ToolTarget> targets;
  for (const NumberTable::Row& row : table.rows) {
    if (!wrong.empty() && std::ranges::count(at, table.header.size()) > 0) break;
    ToolTarget target;
    for (std::size_t n = 0; n < 3; ++n) {
      target.tip_mm[n] = row.values[at[n]];
      target.direction[n] = row.values[at[n + 3]];
    }
    const auto& [i, j, k] = target.direction;
    const double length = std::hypot(i, j, k);
    if (!(length > 1e-9)) complain(row.line, "has a direction i,j,k of no length");
    for (double& component : target.direction) component /= length;
    targets.push_back(target);
  }
  if (!wrong.empty()) throw InputError(std::move(wrong));
  return targets;
}

std::string poses_csv(std::span<const ToolPose> poses, std::span<const double> twists_rad) {
  std::string text = "x[mm],y[mm],z[mm],i,j,k,twist[deg]\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const double component : poses[i].tip_mm) append(text, component, ',');
    for (const double component : poses[i].direction) append(text, component, ',');
    append(text, twists_rad[i] / rad_per_deg, '\n');
  }
  return text;
}

std::string axes_csv(const Machine& machine,
                     std::span<const std::vector<AxisPositions>> solutions) {
  std::vector<AxisName> names;
  for (const MachineAxis& axis : machine.axes) names.push_back(axis.name);
  std::ranges::sort(names);
  std::string text = "point,solution";
  for (const AxisName name : names) text += ',' + usual(*machine.find(name));
  text += '\n';
  for (std::size_t point = 0; point < solutions.size(); ++point) {
    for (std::size_t i = 0; i < solutions[point].size(); ++i) {
      text += std::to_string(point + 1) + ',' + std::to_string(i + 1) + ',';
      for (const AxisName name : names)
        append(text, solutions[point][i][index_of(name)] / edge_unit(name),
               name == names.back() ? '\n' : ',');
    }
  }
  return text;
}

}  // namespace trueaxis
