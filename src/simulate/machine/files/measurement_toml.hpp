// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "simulate/machine/measure.hpp"

namespace trueaxis {

/// A measurement to be played on the virtual machine.
struct MeasurementScenario {
  Machine machine;
  ErrorModel errors;
  virtual_machine::MeasurementPlan plan;
  std::vector<std::string> read;  ///< the files that it names
};

/// Whether a scenario is one of a machine: it has a table `[machine]`.
bool is_measurement_scenario(const std::string& path);

/// Reads a scenario with `[machine]` and `[measure]` (docs/machine.md).
/// @throws InputError with every diagnostic: file, line, column, what to do.
MeasurementScenario read_measurement_toml(const std::string& path);

}  // namespace trueaxis
