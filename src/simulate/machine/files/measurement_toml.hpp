// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "simulate/machine/files/scenario_machine.hpp"

namespace trueaxis {

/// A measurement to be played on the virtual machine.
struct MeasurementScenario {
  ScenarioMachine of;
  virtual_machine::MeasurementPlan plan;
};

/// Reads a scenario with `[machine]` and `[measure]` (docs/machine.md).
/// @throws InputError with every diagnostic: file, line, column, what to do.
MeasurementScenario read_measurement_toml(const std::string& path);

}  // namespace trueaxis
