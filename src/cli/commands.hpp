// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace trueaxis::cli {

// Each adds the command of its name to `app`; the code that it ends with goes to `exit_code`.
void add_run(CLI::App& app, int& exit_code);
void add_init(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_fit(CLI::App& app, int& exit_code);
void add_form(CLI::App& app, int& exit_code);
void add_diagnose(CLI::App& app, int& exit_code);
void add_associate(CLI::App& app, int& exit_code);
void add_advise(CLI::App& app, int& exit_code);
void add_correct(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_spindle(CLI::App& app, int& exit_code);
void add_locate(CLI::App& app, int& exit_code);
void add_datum(CLI::App& app, int& exit_code);
void add_axis_bias(CLI::App& app, int& exit_code);
void add_compensate(CLI::App& app, int& exit_code);
void add_effects(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_pose(CLI::App& app, int& exit_code);
void add_axes(CLI::App& app, int& exit_code);
void add_machine(CLI::App& app, int& exit_code);
void add_errors(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_man(CLI::App& app, int& exit_code);

}  // namespace trueaxis::cli
