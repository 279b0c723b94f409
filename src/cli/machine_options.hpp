// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/results.hpp"
#include "format/json.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "trueaxis/machine.hpp"

/// Options that the commands about machines share.
namespace trueaxis::cli {

struct MachineOptions {
  std::string machine, sign, work_offset = "G54";
  std::vector<std::string> errors;
  bool large_errors = false;

  void add_machine_to(CLI::App& command);
  void add_errors_to(CLI::App& command);
  void add_work_offset_to(CLI::App& command);

  /// The machine read. @throws InputError
  MachineFile read_machine() const;
  /// Its errors, of all files. @throws InputError
  ErrorsOfFiles read_errors_of(const MachineFile& file) const;
  /// The program frame and tool to begin with. @throws InputError for an offset that is not there.
  Setting setting_of(const Machine& machine) const;
};

/// A table that is printed, or written to `--output`, and its rows as JSON.
struct TableOutput {
  Results results;
  bool check = false;

  /// @param schema without the version, of the table and of the JSON
  void add_to(CLI::App& command, const std::string& schema);
  /// @param read files that the command reads, none of which is written over
  /// @param would what the command does, for `--check`
  int print_or_write(const std::string& schema, const std::string& table, const Json& rows,
                     const std::vector<std::string>& read, const std::string& would) const;
};

std::optional<ErrorSign> sign_of(const std::string& word);
CLI::Validator a_sign();

}  // namespace trueaxis::cli
