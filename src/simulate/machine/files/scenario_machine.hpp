// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "simulate/machine/measure.hpp"

namespace trueaxis {

/// What a scenario with a table `[machine]` is of.
enum class MachineScenarioKind { none, measurement, cut };

/// A scenario without `[machine]` is none; one with `[cut]` cuts, any other measures.
MachineScenarioKind machine_scenario_kind(const std::string& path);

/// The machine of a scenario, what it does beside its model, and the files that say so.
struct ScenarioMachine {
  Machine machine;
  ErrorModel errors;
  std::vector<std::string> read;
};

/// Reads the table `[machine]`. Where it names no machine, nothing that follows can be read: the
/// document is finished without looking into `rest`.
/// @throws InputError
ScenarioMachine read_scenario_machine(TomlTable table, TomlTable rest, TomlDocument& document);

/// A key of three numbers; zeros where it is not there.
Vector3 triple(TomlTable& table, const std::string& key);

/// "X_mm", "C_rad": the key of a position of an axis.
std::string key_of(AxisName axis);

/// @param slips a ball may slip on its table
virtual_machine::Disturbance read_disturbance(TomlTable table, const Machine& machine, bool slips);

}  // namespace trueaxis
