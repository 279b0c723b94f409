// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace trueaxis::cli {

/// Adds `trueaxis simulate` to `app`; the code that it ends with goes to `exit_code`.
void add_simulate(CLI::App& app, int& exit_code);

}  // namespace trueaxis::cli
