// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <span>

/// All commands as data: help, manual, completion and the tests of the pages are made of it.
namespace trueaxis::cli {

struct CommandEntry {
  const char* group;
  const char* name;  ///< one word, or two: "machine calibrate"
  const char* line;  ///< what it does
  std::array<const char*, 2> examples;
  const char* page;
  void (*add)(CLI::App* command, int& exit_code);
};

/// In the order in which help lists them, group by group.
std::span<const CommandEntry> catalogue();

/// Adds every command of the catalogue to `app`, a first word of two as a command that holds the
/// others.
void add_commands(CLI::App& app, int& exit_code);

/// The entry of a command, nullptr for the program and for a first word of two.
const CommandEntry* entry_of(const CLI::App& command);

/// The words after "trueaxis": "machine calibrate".
std::string full_name(const CLI::App& command);

/// Help of the program, of a first word or of a command.
std::string help_of(const CLI::App* command, const std::string& name, CLI::AppFormatMode mode);

/// What to do next if no command was typed.
std::string first_steps();

}  // namespace trueaxis::cli
