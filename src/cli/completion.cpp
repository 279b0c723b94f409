// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/described.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"

namespace trueaxis::cli {
namespace {

/// Cases for the word after an option that takes a value.
std::string values_of(const DescribedCommand& command) {
  std::string cases, any;
  for (const DescribedOption& option : command.options) {
    if (option.argument || !option.takes_value) continue;
    const std::string names = fmt::format("{}", fmt::join(option.names, "|"));
    if (option.choices.empty())
      any += (any.empty() ? "" : "|") + names;
    else
      cases += fmt::format("        {}) words='{}' ;;\n", names, fmt::join(option.choices, " "));
  }
  if (!any.empty()) cases += "        " + any + ") words=; value=file ;;\n";
  return cases;
}

std::string words_of(const DescribedCommand& command) {
  std::string words, of_first_argument;
  for (const DescribedOption& option : command.options) {
    if (option.argument)
      of_first_argument +=
          fmt::format("{}{}", option.choices.empty() ? "" : " ", fmt::join(option.choices, " "));
    else
      words += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(option.names, " "));
  }
  return words + of_first_argument;
}

std::string case_of(const DescribedCommand& command) {
  return fmt::format("    '{}')\n      words='{}'\n      case $previous in\n{}      esac ;;\n",
                     command.name, words_of(command), values_of(command));
}

/// The next words of commands' names after the word `before`, each once.
std::string names_of(const std::vector<DescribedCommand>& commands, const std::string& before) {
  std::vector<std::string> names;
  for (const DescribedCommand& command : commands) {
    if (!before.empty() && !command.name.starts_with(before + ' ')) continue;
    const std::string rest = command.name.substr(before.empty() ? 0 : before.size() + 1);
    const std::string word = rest.substr(0, rest.find(' '));
    if (std::ranges::find(names, word) == names.end()) names.push_back(word);
  }
  return fmt::format("{}", fmt::join(names, " "));
}

/// The first words of names of two.
std::vector<std::string> first_words(const std::vector<DescribedCommand>& commands) {
  std::vector<std::string> words;
  for (const DescribedCommand& command : commands)
    if (const std::size_t blank = command.name.find(' ');
        blank != std::string::npos &&
        std::ranges::find(words, command.name.substr(0, blank)) == words.end())
      words.push_back(command.name.substr(0, blank));
  return words;
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  const std::vector<DescribedCommand> commands = commands_of(app);
  std::string script = "# trueaxis " TRUEAXIS_VERSION ": made by `trueaxis completion " + shell +
                       "` from its tables of options\n";
  if (shell == "zsh")
    script = "#compdef trueaxis\n" + script + "autoload -U +X bashcompinit && bashcompinit\n";
  const std::vector<std::string> firsts = first_words(commands);
  script +=
      "_trueaxis() {\n"
      "  local now=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  local name=${COMP_WORDS[1]} last=1 value=\n"
      "  local words='" +
      names_of(commands, "") +
      " --help --version'\n"
      "  COMPREPLY=()\n"
      "  case $name in\n";
  for (const std::string& word : firsts)
    script += fmt::format(
        "    {}) if [ \"$COMP_CWORD\" -gt 1 ]; then words='{} --help'; fi\n"
        "      name=\"$name ${{COMP_WORDS[2]}}\" last=2 ;;\n",
        word, names_of(commands, word));
  script +=
      "  esac\n"
      "  if [ \"$COMP_CWORD\" -gt \"$last\" ]; then\n"
      "    words=\n"
      "    case $name in\n";
  for (const DescribedCommand& command : commands) script += case_of(command);
  script +=
      "    esac\n"
      "    # Files, but where an option is begun or a word of a few is due.\n"
      "    case $now in\n"
      "      -*) ;;\n"
      "      *) case $words in\n"
      "           ''|-*) COMPREPLY=($(compgen -f -- \"$now\")) ;;\n"
      "         esac ;;\n"
      "    esac\n"
      "    [ \"$value\" = file ] && return\n"
      "  fi\n"
      "  COMPREPLY+=($(compgen -W \"$words\" -- \"$now\"))\n"
      "}\n"
      "complete -o filenames -F _trueaxis trueaxis\n";
  if (shell == "zsh")  // zsh reads an installed one by calling it: that call completes as well
    script +=
        "[[ ${funcstack[1]} = _trueaxis ]] && _bash_complete -o filenames -F _trueaxis || true\n";
  return script;
}

void add_completion(CLI::App* command, int& exit_code) {
  auto shell = std::make_shared<std::string>("bash");
  add_option(*command, "shell", *shell, one_of({"bash", "zsh"}), "shell (default bash)");
  command->callback([command, shell, &exit_code] {
    std::cout << completion_script(*command->get_parent(), *shell);
    exit_code = done;
  });
}

}  // namespace trueaxis::cli
