// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trueaxis::platform {

enum class Stream { output, error };

bool is_terminal(Stream stream);
std::optional<std::size_t> columns_of(Stream stream);  ///< nothing: no terminal, or it does not say

/// The words after the program's name, in UTF-8; standard input and output are bytes from now on.
std::vector<std::string> begin_program(int argc, char** argv);

/// Calls `stop` when the user or the system asks the program to end, until on_stop(nullptr). What
/// it writes while nobody reads it is lost without ending it.
void on_stop(void (*stop)(int));

/// Shows a page in the browser; false: there is none.
bool open_in_browser(const std::string& path);

/// Whether the terminal closes with this program: it was begun by a click or by a file dropped on
/// it.
bool terminal_is_own();

}  // namespace trueaxis::platform
