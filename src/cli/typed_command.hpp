// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "cli/catalogue.hpp"

namespace trueaxis::cli {

/// The words of a command as they were typed, in that order, without the options `but`.
inline std::vector<std::string> typed_command(const CLI::App& command,
                                              const std::vector<std::string>& but = {}) {
  std::vector<std::string> words{"trueaxis"};
  std::istringstream name(full_name(command));
  for (std::string word; name >> word;) words.push_back(word);
  std::vector<const CLI::Option*> seen;
  for (const CLI::Option* option : command.parse_order()) {
    const std::string name = option->get_name();
    if (std::ranges::find(but, name) != but.end() || std::ranges::find(seen, option) != seen.end())
      continue;
    seen.push_back(option);
    if (!option->get_positional()) words.push_back(name);
    if (option->get_items_expected_max() == 0) continue;  // a flag
    for (const std::string& value : option->results()) words.push_back(value);
  }
  return words;
}

}  // namespace trueaxis::cli
