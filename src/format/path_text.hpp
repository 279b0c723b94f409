// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace trueaxis {

/// The text of a path, with slashes in every system: a result has the same bytes on each.
std::string path_text(const std::filesystem::path& path);

/// The path of what the file at `file` calls `name`: from its folder on, and as short as possible.
std::string path_next_to(const std::string& file, const std::string& name);

}  // namespace trueaxis
