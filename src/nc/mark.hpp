// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace trueaxis::nc {

/// A compensated program with a mark that says so: a comment at the end of its first line without
/// `%` and comments, the last of which alone counts for LinuxCNC. A program without such a line has
/// none.
std::string marked(std::string text);

/// The line (from 1) with the mark, in capitals or not; none: the program has none.
std::optional<std::size_t> marked_line(std::string_view text);

std::string without_mark(std::string text);

}  // namespace trueaxis::nc
