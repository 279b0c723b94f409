// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// A machine as a file states it. A D-H file also gives the errors of its parameters, as location
/// errors of the axes and the spindle (no terms: it states none).
struct MachineFile {
  Machine machine;
  ErrorModel parameter_errors;
  bool denavit_hartenberg = false;
  std::string hash{};  ///< of the bytes that were read
};

/// Reads `trueaxis.machine/1` (docs/reference/machine.md), in its zero-position or its D-H form.
/// @throws InputError with every diagnostic: file, line, column, what to do.
MachineFile read_machine_toml(const std::string& path);

/// In the zero-position form: what `read_machine_toml` reads back.
std::string machine_toml(const Machine& machine);

}  // namespace trueaxis
