// SPDX-License-Identifier: Apache-2.0
#include "cli/program.hpp"

#include <algorithm>
#include <iostream>

#include "cli/catalogue.hpp"
#include "cli/guarded.hpp"
#include "format/nearest_key.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

std::vector<const CLI::App*> all_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Why a word is not a command, and which it may mean; empty if all are.
std::string unknown_command(const CLI::App& app, const std::vector<std::string>& words,
                            std::size_t at = 0) {
  const auto below = all_commands(app);
  if (below.empty() || at >= words.size() || words[at].starts_with('-')) return "";
  std::vector<std::string> names;
  for (const CLI::App* command : below) {
    if (command->get_name() == words[at]) return unknown_command(*command, words, at + 1);
    names.push_back(command->get_name());
  }
  const std::string program = "trueaxis" + (at > 0 ? " " + words[0] : std::string());
  const std::string near = nearest_key(words[at], names);
  return program + " has no command " + words[at] +
         (near.empty() ? "" : ", did you mean " + near + "?") + "\n" + program +
         " --help lists all.\n";
}

/// The first word of two was typed without the second: what may follow it.
std::string without_second_word(const CLI::App& app) {
  const CLI::App* const first = app.get_subcommands().front();
  return entry_of(*first) == nullptr && first->get_subcommands().empty() ? first->help() : "";
}

}  // namespace

int run_program(const std::vector<std::string>& words) {
  CLI::App app{
      "TrueAxis finds where the reference surfaces of a clamped part really are, and what to "
      "correct."};
  app.formatter_fn(help_of);
  app.set_version_flag("--version", "trueaxis " TRUEAXIS_VERSION);
  app.footer(
      "Exit codes: 0 done, 1 refused, not met or not known, 2 usage, 3 input, 4 numerical, 70 a "
      "bug.");
  int code = done;
  add_commands(app, code);
  NewNames names = with_new_names(words);
  std::cerr << names.notes;
  try {
    app.parse(std::vector<std::string>(names.words.rbegin(), names.words.rend()));
  } catch (const CLI::ParseError& error) {
    if (const std::string why = unknown_command(app, names.words); !why.empty()) {
      std::cerr << why;
      return usage;
    }
    return app.exit(error) == 0 ? done : usage;
  }
  const std::string missing =
      app.get_subcommands().empty() ? first_steps() : without_second_word(app);
  if (!missing.empty()) {
    std::cerr << missing;
    return usage;
  }
  if (!std::cout.flush()) throw InputError("standard output", "cannot be written");
  return code;
}

}  // namespace trueaxis::cli
