// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "format/toml_reader.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// [part], [probe], [noise], [[pass]], [[setup]], [[effect]] and [cut] of a table.
void read_scenario_tables(TomlTable root, virtual_lathe::Scenario& scenario);

/// The lists [[pass]], [[setup]] and [[effect]] of a table; a face's passes run along X.
std::vector<virtual_lathe::PlannedPass> read_passes(TomlTable table, bool face);
std::vector<virtual_lathe::Chucking> read_setups(TomlTable table);
std::vector<virtual_lathe::Effect> read_effects(TomlTable table);

}  // namespace trueaxis
