// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace trueaxis::cli {

// Each gives `command` its options and its action; the code that it ends with goes to `exit_code`.
void add_init(CLI::App* command, int& exit_code);
void add_import(CLI::App* command, int& exit_code);
void add_run(CLI::App* command, int& exit_code);
void add_watch(CLI::App* command, int& exit_code);
void add_fit(CLI::App* command, int& exit_code);
void add_form(CLI::App* command, int& exit_code);
void add_spindle(CLI::App* command, int& exit_code);
void add_diagnose(CLI::App* command, int& exit_code);
void add_advise(CLI::App* command, int& exit_code);
void add_table(CLI::App* command, int& exit_code);
void add_simulate(CLI::App* command, int& exit_code);
void add_calibrate(CLI::App* command, int& exit_code);
void add_machine_diagnose(CLI::App* command, int& exit_code);
void add_compensate(CLI::App* command, int& exit_code);
void add_pose(CLI::App* command, int& exit_code);
void add_inverse(CLI::App* command, int& exit_code);
void add_errors(CLI::App* command, int& exit_code);
void add_machine_import(CLI::App* command, int& exit_code);
void add_machine_simulate(CLI::App* command, int& exit_code);
void add_setup_locators(CLI::App* command, int& exit_code);
void add_setup_datums(CLI::App* command, int& exit_code);
void add_plan(CLI::App* command, int& exit_code);
void add_sweep(CLI::App* command, int& exit_code);
void add_axis_bias(CLI::App* command, int& exit_code);
void add_effects(CLI::App* command, int& exit_code);
void add_completion(CLI::App* command, int& exit_code);
void add_man(CLI::App* command, int& exit_code);

}  // namespace trueaxis::cli
