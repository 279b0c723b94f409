// SPDX-License-Identifier: Apache-2.0
#include "machine/files/machine_toml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.hpp"
#include "base/text.hpp"
#include "format/file.hpp"
#include "machine/files/toml_parts.hpp"
#include "machine/zero_position.hpp"

namespace trueaxis {
namespace {

/// From where to where an axis goes, where its table says so.
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

/// `chain` of either form; what is wrong with it is noted there.
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

using AxisValues = std::array<std::optional<double>, axis_count>;

const char* const no_such_axis = "refers to an axis the chain does not have: remove it";

/// `{X = 1.5, C = 30}`: mm and degrees by letter.
void read_by_letter(TomlTable table, const Machine& machine, AxisValues& values) {
  for (const std::string& key : table.keys()) {
    const auto axis = axis_of(key);
    if (!axis) continue;  // reported as unknown
    if (const auto value = table.maybe_number(key))
      values[index_of(*axis)] = *value * edge_unit(*axis);
    if (machine.find(*axis) == nullptr) table.complain(key, no_such_axis);
  }
  for (const MachineAxis& axis : machine.axes)
    table.has(std::string_view("XYZABC").substr(index_of(axis.name), 1));
}

/// "X0 Y-20.5 C90": words as a program has them.
std::string read_words(std::string_view text, const Machine& machine, AxisValues& values) {
  const std::size_t all = text.size();
  while (!text.empty()) {
    if (take_word(text, " ") || take_word(text, "\t")) continue;
    const std::size_t at = all - text.size();
    const auto axis = axis_of(text.substr(0, 1));
    text.remove_prefix(1);
    const auto value = take_number<double>(text);
    if (!axis || machine.find(*axis) == nullptr || !value || !std::isfinite(*value))
      return "is not a list of words of this machine's axes, such as \"X0 Y0 Z100\" (character " +
             std::to_string(at + 1) + ')';
    values[index_of(*axis)] = *value * edge_unit(*axis);
  }
  return "";
}

void read_start(TomlTable& program, Machine& machine) {
  if (program.has_table("start")) {
    read_by_letter(*program.maybe_table("start"), machine, machine.start);
  } else if (const auto text = program.maybe_text("start")) {
    const std::string trouble = read_words(*text, machine, machine.start);
    if (!trouble.empty()) program.complain("start", trouble);
  }
}

void read_tools(TomlTable tools, Machine& machine) {
  for (const std::string& key : tools.keys()) {
    const int number = whole_number<int>(key).value_or(-1);
    auto tool = tools.maybe_table(key);
    if (number < 0) tools.complain(key, "is not a tool number: write [tools.3] for T3");
    if (tool) machine.tool_lengths_mm[number] = tool->required_number("length_mm");
  }
}

WorkOffset read_offset(TomlTable table, const Machine& machine) {
  WorkOffset offset;
  offset.bed_from_program.origin_mm = read_vector(table, "origin_mm");
  offset.bed_from_program.rotation = rotation_zyx(read_vector(table, "rotation_rad"));
  AxisValues zero;
  if (const auto positions = table.maybe_table("zero")) read_by_letter(*positions, machine, zero);
  for (std::size_t i = 0; i < axis_count; ++i) offset.zero[i] = zero[i].value_or(0.0);
  return offset;
}

void read_mode(TomlTable& program, Machine& machine, bool needed) {
  using enum ProgramMode;
  if (needed)
    machine.mode = program.required_choice<ProgramMode>("mode", {{"axes", axes}, {"tip", tip}});
  else
    machine.mode = program.choice<ProgramMode>("mode", {{"axes", axes}, {"tip", tip}}, axes);
}

/// `tools`, `workpiece`, `program` and `compensation`: what both forms of a machine's file have.
/// `mode_needed`: `program.mode` has no default.
void read_program_parts(TomlTable& root, Machine& machine, bool mode_needed) {
  if (auto tools = root.maybe_table("tools")) read_tools(*tools, machine);
  if (auto workpiece = root.maybe_table("workpiece")) {
    for (std::size_t i = 0; i < work_offset_count; ++i)
      if (auto offset = workpiece->maybe_table(fmt::format("G{}", 54 + i)))
        machine.work_offsets[i] = read_offset(*offset, machine);
  }
  if (auto program = root.maybe_table("program")) {
    read_mode(*program, machine, mode_needed);
    read_start(*program, machine);
  } else if (mode_needed) {
    root.complain("program",
                  "is missing: state in program.mode whether the words are \"axes\" (positions of "
                  "the axes) or \"tip\" (X Y Z of the tip in the program frame)");
  }
  if (auto compensation = root.maybe_table("compensation"))
    machine.max_rotary_change_rad = compensation->number(
        "max_rotary_change_rad", machine.max_rotary_change_rad, Range::between(0.0, two_pi));
}

/// `axis` and `variable` of a row: both or none, a rotary axis with theta, a linear one with d.
std::optional<AxisName> read_joint(TomlTable& table, const Machine& machine) {
  const std::string letter = table.text("axis");
  const std::string variable = table.text("variable");
  if (letter.empty() && variable.empty()) return std::nullopt;
  const auto axis = axis_of(letter);
  if (!axis || machine.find(*axis) == nullptr) {
    table.complain("axis", "must be an axis of the chain, as the row has a variable");
    return std::nullopt;
  }
  const std::string belongs = is_rotary(*axis) ? "theta" : "d";
  if (variable != belongs)
    table.complain("variable", "must be \"" + belongs + "\" for the axis " + letter);
  return axis;
}

DenavitHartenbergRow read_row(TomlTable table, const Machine& machine) {
  DenavitHartenbergRow row;
  table.text("link");
  row.nominal = {table.number("theta_rad", 0.0), table.number("d_mm", 0.0),
                 table.number("a_mm", 0.0), table.number("alpha_rad", 0.0)};
  row.errors = {table.number("theta_error_rad", 0.0), table.number("d_error_mm", 0.0),
                table.number("a_error_mm", 0.0), table.number("alpha_error_rad", 0.0)};
  row.axis = read_joint(table, machine);
  return row;
}

/// The rows must name the axes of the chain once each, in its order.
void check_order(TomlTable& root, const DenavitHartenbergChain& chain, const Machine& machine) {
  std::string of_rows, of_chain;
  for (const DenavitHartenbergRow& row : chain.rows)
    if (row.axis) of_rows += letter_of(*row.axis);
  for (const MachineAxis& axis : machine.axes) of_chain += letter_of(axis.name);
  if (of_rows != of_chain)
    root.complain("dh", "has the axes " + (of_rows.empty() ? "of no row" : of_rows) +
                            ", the chain from workpiece to tool " + of_chain +
                            ": give one row an axis, in this order");
}

void read_limits_of(TomlTable& root, Machine& machine) {
  auto tables = root.maybe_table("axes");
  if (!tables) return;
  for (MachineAxis& axis : machine.axes) {
    auto table = tables->maybe_table(std::string(1, letter_of(axis.name)));
    if (table) read_limits(*table, axis);
  }
}

/// `[[dh]]`, `part` and `tool` of a D-H file, whose chain is read already, made a zero-position
/// machine in the frame of the part: joint i turns about, or moves along, the z axis of frame i − 1
/// with all variables at 0 (Talyan et al., Tables 1 to 3).
void read_denavit_hartenberg(TomlTable& root, MachineFile& file) {
  DenavitHartenbergChain chain;
  for (TomlTable row : root.tables("dh")) chain.rows.push_back(read_row(row, file.machine));
  if (auto part = root.maybe_table("part"))
    chain.part_translation_mm = read_vector(*part, "translation_mm");
  if (auto tool = root.maybe_table("tool")) chain.tool_length_mm = tool->number("length_mm", 0.0);
  read_limits_of(root, file.machine);
  check_order(root, chain, file.machine);
  to_zero_position(chain, file.machine);
  try {
    file.parameter_errors = parameter_errors(chain, file.machine);
  } catch (const InputError& error) {
    root.complain("dh", error.diagnostics().front().message);
  }
}

}  // namespace

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
