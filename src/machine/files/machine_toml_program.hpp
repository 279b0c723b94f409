// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/toml_reader.hpp"
#include "trueaxis/machine.hpp"

namespace trueaxis {

/// `tools`, `workpiece`, `program` and `compensation`: what both forms of a machine's file have.
/// `mode_needed`: `program.mode` has no default.
void read_program_parts(TomlTable& root, Machine& machine, bool mode_needed);

}  // namespace trueaxis
