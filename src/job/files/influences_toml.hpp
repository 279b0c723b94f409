// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "trueaxis/influence.hpp"

namespace trueaxis {

/// What a table states of machine and probe: `lag_ms` with `u_lag_ms`, or a u alone, of 0.
std::vector<Influence> read_influences(TomlTable& table);

/// The same of options: "lag_ms=0.4±0.1" (or +-), "u_gain=0".
/// @throws InputError for all that is wrong in them
std::vector<Influence> influences_of(const std::vector<std::string>& said);

}  // namespace trueaxis
