// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// `trueaxis simulate` of a scenario with `[machine]`.
namespace trueaxis::cli {

struct SimulateMachineOptions {
  std::string scenario, output, json, program;
  std::optional<std::uint64_t> seed;
  bool force = false, check = false;
};

/// What a machine of several axes would read of balls on its table.
int simulate_measurement(const SimulateMachineOptions& options);

/// What it cuts of a program, and how far that is from what should be cut.
int simulate_machine_cut(const SimulateMachineOptions& options);

}  // namespace trueaxis::cli
