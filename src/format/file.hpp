// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace trueaxis {

/// The whole file, or standard input for "-". @throws InputError when it cannot be read.
std::string read_file(const std::string& path);

/// "xxh3-64:<16 hex digits>" of `bytes`.
std::string content_hash(std::string_view bytes);

}  // namespace trueaxis
