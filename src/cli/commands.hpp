// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace trueaxis::cli {

/// The contract's exit codes.
enum Exit { done = 0, refused = 1, usage = 2, input = 3, numerical = 4, bug = 70 };

/// Each adds its subcommand to `app`; the code it ends with goes to `exit_code`.
void add_run(CLI::App& app, int& exit_code);
void add_fit(CLI::App& app, int& exit_code);
void add_diagnose(CLI::App& app, int& exit_code);
void add_advise(CLI::App& app, int& exit_code);
void add_correct(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_axis_bias(CLI::App& app, int& exit_code);
void add_effects(CLI::App& app, int& exit_code);

}  // namespace trueaxis::cli
