// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <string>

namespace trueaxis {
class Outputs;
}

namespace trueaxis::cli {

/// `--check` of a command that computes: everything is read, every place of a result is looked at,
/// nothing is computed and nothing written.
CLI::Option* add_check(CLI::App& command, bool& check);

/// Says what a command would do ("fit a cone to 1469 readings"), what it has read and what it would
/// write. @returns the exit code
int checked(const Outputs& outputs, const std::string& would);

/// Takes every step, whatever is wrong in those before it.
/// @throws InputError with what is wrong in all of them
void all_of(std::initializer_list<std::function<void()>> steps);

}  // namespace trueaxis::cli
