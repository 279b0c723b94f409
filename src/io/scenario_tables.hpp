// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/toml_reader.hpp"
#include "trueaxis/simulate/scenario.hpp"

namespace trueaxis {

/// [part], [probe], [noise], [[pass]], [[setup]], [[effect]] and [cut] of a table.
void read_scenario_tables(TomlTable root, virtual_lathe::Scenario& scenario);

}  // namespace trueaxis
