// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/toml_reader.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// The [cut] table of a scenario.
virtual_lathe::CutProgram read_cut_program(TomlTable table);

}  // namespace trueaxis
