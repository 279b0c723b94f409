// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/catalogue.hpp"
#include "cli/described.hpp"
#include "format/text_layout.hpp"

namespace trueaxis::cli {
namespace {

constexpr std::size_t name_column = 20, option_column = 27;

std::string command_lines(const std::string& first_word) {
  std::string text, group;
  for (const CommandEntry& entry : catalogue()) {
    const std::string name = entry.name;
    if (!first_word.empty() && !name.starts_with(first_word + ' ')) continue;
    if (group != entry.group) text += std::string(entry.group) + '\n';
    group = entry.group;
    const std::string shown = first_word.empty() ? name : name.substr(first_word.size() + 1);
    text += "  " + layout::padded(shown, name_column) + entry.line + '\n';
  }
  return text;
}

std::string program_help(const CLI::App& app) {
  return app.get_description() +
         "\nUsage: trueaxis COMMAND [OPTIONS]    trueaxis COMMAND --help    trueaxis "
         "--version\n\n" +
         command_lines("") + "\n" + app.get_footer() + '\n';
}

std::string names_of(const DescribedOption& option) {
  std::string names = fmt::format("{}", fmt::join(option.names, ", "));
  return option.takes_value && !option.argument ? names + ' ' + option.value : names;
}

/// Options side by side that are explained by the same words are one line.
std::string option_line(const std::string& names, const DescribedOption& option) {
  std::string left = "  " + names;
  std::string text = option.description;
  if (!option.choices.empty()) text += fmt::format(": {}", fmt::join(option.choices, ", "));
  if (option.required && !option.argument) text += " (required)";
  if (layout::width(left) + 1 > option_column) left += "  ";
  return layout::wrapped(layout::padded(left, option_column), text);
}

std::string group_lines(const DescribedCommand& command, const std::string& group) {
  std::string lines, names;
  const DescribedOption* last = nullptr;
  for (const DescribedOption& option : command.options) {
    if (option.group != group || option.names.back() == "--help") continue;
    const bool same = last != nullptr && last->description == option.description;
    if (last != nullptr && !same) lines += option_line(names, *last);
    names = (same ? names + ", " : "") + names_of(option);
    last = &option;
  }
  return last == nullptr ? lines : lines + option_line(names, *last);
}

std::string usage_of(const DescribedCommand& command) {
  std::string usage = "Usage: trueaxis " + command.name;
  for (const DescribedOption& option : command.options)
    if (option.argument)
      usage += option.required ? ' ' + option.names.front() : " [" + option.names.front() + ']';
  return usage + " [OPTIONS]\n";
}

std::string command_help(const CLI::App& command, const CommandEntry& entry) {
  const DescribedCommand described = described_command(command);
  std::string text = std::string(entry.line) + "\n" + usage_of(described);
  for (const std::string& group : groups_of(described)) {
    if (!group.empty()) text += group + '\n';
    text += group_lines(described, group);
  }
  for (const char* const example : entry.examples)
    text +=
        layout::padded(example == entry.examples.front() ? "Examples:" : "", 10) + example + '\n';
  return text + layout::padded("More:", 10) + entry.page + '\n';
}

}  // namespace

std::string help_of(const CLI::App* command, const std::string& /*name*/,
                    CLI::AppFormatMode /*mode*/) {
  if (command->get_parent() == nullptr) return program_help(*command);
  const CommandEntry* const entry = entry_of(*command);
  if (entry != nullptr) return command_help(*command, *entry);
  const std::string word = full_name(*command);
  return "Usage: trueaxis " + word + " COMMAND [OPTIONS]\n\n" + command_lines(word) +
         "\ntrueaxis " + word + " COMMAND --help shows the options of one.\n";
}

std::string first_steps() {
  return "TrueAxis finds the axis of a clamped part from readings of a probe. Begin with one of:\n"
         "  trueaxis init first                        example files that run\n"
         "  trueaxis run part.csv                      a probe stream: axis, causes, where to tap\n"
         "  trueaxis import export.csv -o part.csv     another program's recording\n"
         "trueaxis --help lists all commands.\n";
}

}  // namespace trueaxis::cli
