// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/toml_reader.hpp"
#include "trueaxis/simulate/cut_program.hpp"

namespace trueaxis {

/// The [cut] table of a scenario.
virtual_lathe::CutProgram read_cut_program(TomlTable table);

}  // namespace trueaxis
