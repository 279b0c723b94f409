// SPDX-License-Identifier: Apache-2.0
#include "cli/described.hpp"

#include <sstream>

namespace trueaxis::cli {
namespace {

/// "TEXT:{cone,cylinder}", as CLI::IsMember names its words.
std::vector<std::string> choices_in(const std::string& type_name) {
  const std::size_t from = type_name.find('{'), to = type_name.find('}');
  std::vector<std::string> words;
  if (from == std::string::npos || to == std::string::npos || to < from) return words;
  std::istringstream list(type_name.substr(from + 1, to - from - 1));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

DescribedOption described(const CLI::Option& option) {
  DescribedOption out;
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  out.argument = out.names.empty();
  if (out.argument) out.names.push_back(option.get_name());
  out.description = option.get_description();
  out.takes_value = option.get_items_expected_max() > 0;
  out.required = option.get_required();
  out.choices = choices_in(option.get_type_name());
  return out;
}

}  // namespace

std::vector<DescribedCommand> commands_of(const CLI::App& app) {
  std::vector<DescribedCommand> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    DescribedCommand out{command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : command->get_options())
      out.options.push_back(described(*option));
    commands.push_back(std::move(out));
  }
  return commands;
}

}  // namespace trueaxis::cli
