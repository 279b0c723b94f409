// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.hpp"
#include "cli/setup_command.hpp"

namespace trueaxis::cli {

void add_datum(CLI::App& app, int& exit_code) {
  add_setup_command(app,
                    {"datum", "where a part is whose datum surfaces have errors",
                     "nine datum errors, or points of the datums (TOML)",
                     [](const std::string& path, int decimals) {
                       return result_of(read_datum_toml(path), decimals);
                     }},
                    exit_code);
}

}  // namespace trueaxis::cli
