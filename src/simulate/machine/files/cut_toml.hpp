// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "simulate/machine/cut.hpp"
#include "simulate/machine/files/scenario_machine.hpp"

namespace trueaxis {

/// A program to be cut on the virtual machine.
struct CutScenario {
  ScenarioMachine of;  ///< its `read` has the programs too
  virtual_machine::CutPlan plan;
};

/// Reads a scenario with `[machine]` and `[cut]` (docs/virtual_machine.md), and its programs.
/// @param program cut instead of that of the scenario, which then is the nominal one where the
///        scenario names no other; "": that of the scenario
/// @throws InputError with every diagnostic: file, line, column, what to do.
CutScenario read_cut_scenario_toml(const std::string& path, const std::string& program);

}  // namespace trueaxis
