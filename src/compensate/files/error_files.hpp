// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "machine/files/machine_toml.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// The errors of several files (`trueaxis.errors/1`) added up, those of a D-H file's parameters
/// with them. Component errors, whose sign and pivots a file says, come from one file.
/// @throws InputError with every diagnostic of all files
ErrorModel read_errors(const std::vector<std::string>& paths, const MachineFile& machine);

}  // namespace trueaxis
