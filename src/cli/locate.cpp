// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.hpp"
#include "cli/setup_command.hpp"

namespace trueaxis::cli {

void add_locate(CLI::App& app, int& exit_code) {
  add_setup_command(app,
                    {"locate", "where a part is on the six measured locators of its fixture",
                     "locators: ideal and measured (TOML)",
                     [](const std::string& path, int decimals) {
                       return result_of(read_locate_toml(path), decimals);
                     }},
                    exit_code);
}

}  // namespace trueaxis::cli
