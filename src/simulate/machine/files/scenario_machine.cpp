// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis {

MachineScenarioKind machine_scenario_kind(const std::string& path) {
  TomlDocument document(path);
  const std::vector<std::string> keys = document.root().keys();
  const auto there = [&](const char* key) { return std::ranges::find(keys, key) != keys.end(); };
  if (!there("machine")) return MachineScenarioKind::none;
  return there("cut") ? MachineScenarioKind::cut : MachineScenarioKind::measurement;
}

ScenarioMachine read_scenario_machine(TomlTable table, TomlTable rest, TomlDocument& document) {
  ScenarioMachine out;
  const std::string file = table.required_path("file");
  const std::optional<std::string> errors = table.maybe_path("errors");
  if (file.empty()) {
    rest.ignore_rest();
    document.finish();
  }
  out.read.push_back(file);
  out.machine = read_machine_toml(file).machine;
  if (errors) {
    out.read.push_back(*errors);
    out.errors = read_errors_toml(*errors, out.machine);
  }
  return out;
}

Vector3 triple(TomlTable& table, const std::string& key) {
  const std::vector<double> list = table.numbers(key);
  if (list.empty()) return {};
  if (list.size() == 3) return {list[0], list[1], list[2]};
  table.complain(key, "has three numbers, along X, Y and Z of the bed");
  return {};
}

std::string key_of(AxisName axis) {
  return std::string(1, letter_of(axis)) + (is_rotary(axis) ? "_rad" : "_mm");
}

virtual_machine::Disturbance read_disturbance(TomlTable table, const Machine& machine, bool slips) {
  virtual_machine::Disturbance by;
  if (std::optional<TomlTable> reversal = table.maybe_table("reversal")) {
    for (const MachineAxis& axis : machine.axes)
      by.reversal[index_of(axis.name)] = reversal->number(key_of(axis.name), 0.0);
  }
  by.drift_mm_per_s = triple(table, "drift_mm_per_s");
  if (!slips) return by;
  by.slip_mm = triple(table, "slip_mm");
  by.slip_after = static_cast<std::size_t>(table.integer("slip_after_rows", 0, 0));
  if (by.slip_after == 0 && table.has("slip_mm"))
    table.complain("slip_mm", "needs `slip_after_rows`: after how many rows the ball slips");
  return by;
}

}  // namespace trueaxis
