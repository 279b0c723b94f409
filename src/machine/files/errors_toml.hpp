// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Reads `trueaxis.errors/1` (docs/machine.md) of a machine.
/// @throws InputError with every diagnostic: file, line, column, what to do.
ErrorModel read_errors_toml(const std::string& path, const Machine& machine);

/// What `read_errors_toml` reads back.
std::string errors_toml(const ErrorModel& errors);

}  // namespace trueaxis
