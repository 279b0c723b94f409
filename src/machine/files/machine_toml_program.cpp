// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "machine/files/toml_parts.hpp"

namespace trueaxis {
namespace {

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

}  // namespace

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

}  // namespace trueaxis
