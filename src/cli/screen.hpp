// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace trueaxis::cli {

/// `--verbose` of a command that prints a screen.
CLI::Option* add_verbose(CLI::App& command, bool& verbose);

/// Prints a screen to standard output: its lines broken to the width of the terminal (100 where
/// there is none, and the first is left whole there), below their text, and its first word, the
/// verdict, in colour on a terminal where NO_COLOR is not set.
void print_screen(const std::string& text);

}  // namespace trueaxis::cli
