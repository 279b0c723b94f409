// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "format/toml_reader.hpp"

namespace trueaxis {

/// `[header]` of a job: `part`, `serial`, `operator`, `machine`, `probe`, `date`, each a text that
/// may be missing. Label and text of those that are there, in this order; empty texts are left out.
std::vector<std::pair<std::string, std::string>> read_header(TomlTable root);

}  // namespace trueaxis
