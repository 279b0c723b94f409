// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The commands and options as tables, for what is made of them: help, completion, manual.
namespace trueaxis::cli {

struct DescribedOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of an argument its name alone
  std::string description;
  std::string group;         ///< empty for an argument
  std::string value;         ///< the word for its value: "FILE", "N"
  bool argument = false;     ///< given by its place
  bool takes_value = false;  ///< --json FILE; not --force
  bool required = false;
  std::vector<std::string> choices;  ///< the words that it takes; empty: any
};

struct DescribedCommand {
  std::string name, description;
  std::vector<DescribedOption> options;
};

DescribedCommand described_command(const CLI::App& command);

/// The groups of its options, in the order of their first.
std::vector<std::string> groups_of(const DescribedCommand& command);

/// Every command of the catalogue, as `app` has it.
std::vector<DescribedCommand> commands_of(const CLI::App& app);

/// `app`'s options as a script that bash or zsh reads.
std::string completion_script(const CLI::App& app, const std::string& shell);

/// trueaxis(1) in troff.
std::string manual(const CLI::App& app);

}  // namespace trueaxis::cli
