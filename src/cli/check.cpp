// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "base/diagnostics.hpp"
#include "base/text.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

CLI::Option* add_check(CLI::App& command, bool& check) {
  return command.add_flag("--check,--dry-run", check,
                          "read all input and list what would be done; write nothing");
}

void add_usual(CLI::App& command, bool& force, bool& check, bool* verbose) {
  add_force(command, force);
  if (verbose) add_verbose(command, *verbose);
  add_check(command, check);
}

namespace {

/// Each once, in order.
std::string names_of(const std::vector<std::string>& all) {
  std::vector<std::string> names;
  for (const std::string& one : all)
    if (std::ranges::find(names, one) == names.end()) names.push_back(one);
  return word_list(names);
}

}  // namespace

int checked(const Outputs& outputs, const std::string& would) {
  std::string text =
      "CHECKED: nothing is wrong with what was read; nothing was computed or written\n";
  text += "would  " + would + "\n";
  if (!outputs.inputs().empty()) text += "read   " + names_of(outputs.inputs()) + "\n";
  if (const auto places = outputs.places(); !places.empty())
    text += "write  " + names_of(places) + "\n";
  print_screen(text);
  return done;
}

void all_of(std::initializer_list<std::function<void()>> steps) {
  std::vector<Diagnostic> wrong;
  for (const auto& step : steps) gather(wrong, step);
  if (!wrong.empty()) throw InputError(std::move(wrong));
}

}  // namespace trueaxis::cli
