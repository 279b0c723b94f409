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

/// Whether two programs differ in axis words, F, G93 and G94, and in lines of these only: one may
/// be the other, compensated. An empty program is like none.
bool differ_in_axis_words_only(std::string_view one, std::string_view other);

}  // namespace trueaxis::nc
