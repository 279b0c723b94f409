// SPDX-License-Identifier: Apache-2.0
#include "cli/described.hpp"

#include <algorithm>
#include <sstream>

#include "cli/catalogue.hpp"

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

/// What CLI11 names the type of a value, "TEXT:FILE" or "FLOAT:number", in one word.
std::string value_word(const CLI::Option& option, bool of_few) {
  const std::string type = option.get_type_name();
  const auto has = [&](const char* word) { return type.find(word) != std::string::npos; };
  if (of_few) return "WORD";
  return has("FLOAT") || has("INT") ? "N" : type;
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
  out.value = value_word(option, !out.choices.empty());
  out.group = out.argument ? "" : option.get_group();
  return out;
}

}  // namespace

DescribedCommand described_command(const CLI::App& command) {
  DescribedCommand out{full_name(command), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options()) {
    const bool hidden = !option->get_lnames().empty() && option->get_group().empty();
    if (!hidden) out.options.push_back(described(*option));
  }
  return out;
}

std::vector<std::string> groups_of(const DescribedCommand& command) {
  std::vector<std::string> groups;
  for (const DescribedOption& option : command.options)
    if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
  std::ranges::stable_partition(groups, [](const std::string& one) { return one.empty(); });
  std::ranges::stable_partition(groups, [](const std::string& one) { return one != "Options"; });
  return groups;
}

std::vector<DescribedCommand> commands_of(const CLI::App& app) {
  std::vector<DescribedCommand> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (entry_of(*command) != nullptr) commands.push_back(described_command(*command));
    for (DescribedCommand& one : commands_of(*command)) commands.push_back(std::move(one));
  }
  return commands;
}

}  // namespace trueaxis::cli
