// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "fixture/files/setup_output.hpp"

/// What `locate` and `datum` have in common: one file in, a set-up out.
namespace trueaxis::cli {

struct SetupCommand {
  const char *name, *description, *file;
  /// Reads the file and finds the set-up, its frames with so many decimals.
  SetupResult (*solve)(const std::string& path, int decimals);
};

void add_setup_command(CLI::App& app, const SetupCommand& which, int& exit_code);

}  // namespace trueaxis::cli
