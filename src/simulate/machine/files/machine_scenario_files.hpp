// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "simulate/machine/cut.hpp"
#include "simulate/machine/measure.hpp"

namespace trueaxis {

/// What a scenario with a table `[machine]` is of.
enum class MachineScenarioKind { none, measurement, cut };

/// A scenario without `[machine]` does not belong here; one with `[cut]` cuts, any other measures.
MachineScenarioKind machine_scenario_kind(const std::string& path);

/// The machine of a scenario, what it does in addition to its model, and the files that say so.
struct ScenarioMachine {
  Machine machine;
  ErrorModel errors;
  std::vector<std::string> read;
};

/// Reads the table `[machine]`. If it names no machine, nothing that follows can be read: the
/// document is finished without looking into `rest`.
/// @throws InputError
ScenarioMachine read_scenario_machine(TomlTable table, TomlTable rest, TomlDocument& document);

/// A key of three numbers; zeros where it is not there.
Vector3 triple(TomlTable& table, const std::string& key);

/// "X_mm", "C_rad": the key of a position of an axis.
std::string key_of(AxisName axis);

/// @param slips a ball may slip on its table
virtual_machine::Disturbance read_disturbance(TomlTable table, const Machine& machine, bool slips);

/// A measurement to be played on the virtual machine.
struct MeasurementScenario {
  ScenarioMachine of;
  virtual_machine::MeasurementPlan plan;
};

/// Reads a scenario with `[machine]` and `[measure]` (docs/reference/machine.md).
/// @throws InputError with every diagnostic: file, line, column, what to do.
MeasurementScenario read_measurement_toml(const std::string& path);

/// A program to be cut on the virtual machine.
struct CutScenario {
  ScenarioMachine of;  ///< its `read` has the programs too
  virtual_machine::CutPlan plan;
};

/// Reads a scenario with `[machine]` and `[cut]` (virtual-machine.md), and its programs.
/// @param program cut instead of that of the scenario, which then is the nominal one where the
///        scenario names no other; "": that of the scenario
/// @throws InputError with every diagnostic: file, line, column, what to do.
CutScenario read_cut_scenario_toml(const std::string& path, const std::string& program);

/// The rows of a measurement in the columns of its kind (calibration.md), mm, degrees and µm.
std::string measurement_csv(const Machine& machine, const virtual_machine::MeasurementPlan& plan,
                            const std::vector<virtual_machine::MeasuredRow>& rows);

/// `line,end,t[s],x[mm],y[mm],z[mm],i,j,k,off[um],angle[deg]`, a row per position; unknown numbers
/// are empty (docs/reference/virtual-machine.md).
std::string cut_csv(const virtual_machine::Cut& cut);

/// `trueaxis.cut/1`.
std::string cut_json(const virtual_machine::Cut& cut, const CutScenario& scenario);

/// The same in sentences.
std::string cut_text(const virtual_machine::Cut& cut, const CutScenario& scenario);

}  // namespace trueaxis
