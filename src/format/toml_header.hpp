// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "format/json.hpp"
#include "format/toml_reader.hpp"

namespace trueaxis {

/// `[header]` of a job: `part`, `serial`, `operator`, `machine`, `probe`, `date`, each a text that
/// may be missing; `date` may be a date of TOML (2026-03-14) as well. Label and text of those that
/// are there, in this order, without empty texts.
std::vector<std::pair<std::string, std::string>> read_header(TomlTable root);

/// The same as a result has it: the keys of the job with their texts.
Json header_object(const std::vector<std::pair<std::string, std::string>>& header);

}  // namespace trueaxis
