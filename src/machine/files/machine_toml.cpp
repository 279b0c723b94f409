// SPDX-License-Identifier: Apache-2.0
#include "machine/files/machine_toml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "format/file.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

void read_limits(TomlTable& table, MachineAxis& axis) {
  const char* const key = is_rotary(axis.name) ? "limits_rad" : "limits_mm";
  if (!table.has(key)) return;
  const std::vector<double> limits = table.numbers(key);
  if (limits.size() != 2 || !(limits[0] < limits[1])) {
    table.complain(key, "must hold two numbers, the smaller first: [low, high]");
    return;
  }
  axis.low = limits[0];
  axis.high = limits[1];
}

void read_axis(TomlTable table, MachineAxis& axis) {
  axis.direction = read_direction(table, "direction", axis.direction);
  if (is_rotary(axis.name))
    axis.point_mm = read_vector(table, "point_mm");
  else if (table.has("point_mm"))
    table.complain("point_mm", "has no meaning for a linear axis: remove it");
  read_limits(table, axis);
}

void read_axes(TomlTable& root, Machine& machine) {
  auto tables = root.maybe_table("axes");
  if (!tables) return;
  for (const std::string& key : tables->keys()) {
    const auto name = axis_of(key);
    const auto axis = std::ranges::find_if(
        machine.axes, [&](const MachineAxis& one) { return name && one.name == *name; });
    if (axis == machine.axes.end())
      tables->complain(key, "is not an axis of the chain \"" + machine.chain + '"');
    auto table = tables->maybe_table(key);
    if (table && axis != machine.axes.end()) read_axis(*table, *axis);
    if (table && axis == machine.axes.end()) table->ignore_rest();
  }
}

void read_tool(TomlTable& root, Machine& machine) {
  auto table = root.maybe_table("tool");
  if (!table) return;
  machine.tool.gauge_point_mm = read_vector(*table, "gauge_point_mm");
  machine.tool.direction = read_direction(*table, "direction", machine.tool.direction);
  machine.tool.length_mm = table->number("length_mm", 0.0);
}

}  // namespace

void read_chain(TomlTable& root, Machine& machine) {
  machine.chain = root.required_text("chain");
  if (machine.chain.empty()) return;
  std::vector<ChainTrouble> troubles;
  machine.axes = parse_chain(machine.chain, troubles);
  for (const ChainTrouble& trouble : troubles)
    root.complain("chain",
                  trouble.message + (trouble.at > 0 ? fmt::format(" (character {})", trouble.at + 1)
                                                    : std::string()));
}

MachineFile read_machine_toml(const std::string& path) {
  const std::string content = read_file(path);
  TomlDocument document(content, path);
  TomlTable root = document.root();
  MachineFile file;
  file.hash = content_hash(content);
  file.denavit_hartenberg = root.has("dh");
  if (!file.denavit_hartenberg || root.has("schema"))
    root.required_choice<int>("schema", {{"trueaxis.machine/1", 1}});
  file.machine.name = root.text("name");
  read_chain(root, file.machine);
  if (file.denavit_hartenberg) {
    read_denavit_hartenberg(root, file);
  } else {
    read_axes(root, file.machine);
    read_tool(root, file.machine);
  }
  read_program_parts(root, file.machine, !file.denavit_hartenberg);
  document.finish();
  return file;
}

}  // namespace trueaxis
