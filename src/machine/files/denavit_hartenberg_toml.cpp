// SPDX-License-Identifier: Apache-2.0
#include "machine/files/toml_parts.hpp"
#include "machine/zero_position.hpp"

namespace trueaxis {
namespace {

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
    if (!table) continue;
    const char* const key = is_rotary(axis.name) ? "limits_rad" : "limits_mm";
    const std::vector<double> limits = table->numbers(key);
    if (limits.size() == 2 && limits[0] < limits[1]) {
      axis.low = limits[0];
      axis.high = limits[1];
    } else if (table->has(key)) {
      table->complain(key, "must hold two numbers, the smaller first: [low, high]");
    }
  }
}

}  // namespace

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

}  // namespace trueaxis
