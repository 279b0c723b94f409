// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "cli/catalogue.hpp"
#include "cli/commands.hpp"
#include "cli/described.hpp"
#include "cli/guarded.hpp"

namespace trueaxis::cli {
namespace {

/// Text for troff: no line of it becomes a request, hyphens stay hyphens, and what is beyond
/// ASCII is named by its code point.
std::string troff(const std::string& text) {
  std::string out;
  if (text.starts_with('.') || text.starts_with('\'')) out = "\\&";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c < 0x80)
      out += text[i];
    else {
      const int more = c >= 0xF0 ? 3 : c >= 0xE0 ? 2 : 1;
      unsigned code = c & (0x3FU >> more);
      for (int k = 0; k < more && i + 1 < text.size(); ++k)
        code = code << 6U | (static_cast<unsigned char>(text[++i]) & 0x3FU);
      out += fmt::format("\\[u{:04X}]", code);
    }
  }
  return out;
}

std::string option_entry(const DescribedOption& option) {
  std::string head;
  for (const std::string& name : option.names)
    head += fmt::format("{}{}{}\\fR", head.empty() ? "" : ", ", option.argument ? "\\fI" : "\\fB",
                        troff(name));
  if (!option.choices.empty())
    head += troff(fmt::format(" {}", fmt::join(option.choices, "|")));
  else if (!option.argument && option.takes_value)
    head += " \\fIVALUE\\fR";
  return ".TP\n" + head + "\n" + troff(option.description) +
         (option.required ? " (required)" : "") + "\n";
}

std::string command_entry(const DescribedCommand& command) {
  std::string text =
      ".SS trueaxis " + troff(command.name) + "\n" + troff(command.description) + "\n";
  for (const DescribedOption& option : command.options)
    if (option.names.back() != "--help") text += option_entry(option);
  const auto entry = std::ranges::find(catalogue(), command.name, &CommandEntry::name);
  text += ".PP\nExamples:\n.PP\n.nf\n";
  for (const char* const example : entry->examples) text += "    " + troff(example) + '\n';
  return text + ".fi\n.PP\nMore: " + troff(entry->page) + '\n';
}

}  // namespace

std::string manual(const CLI::App& app) {
  std::string text =
      ".\\\" made by `trueaxis man` from its tables of options\n"
      ".TH TRUEAXIS 1 \"\" \"trueaxis " TRUEAXIS_VERSION
      "\"\n"
      ".SH NAME\ntrueaxis \\- axes of clamped parts, errors of machines, and what "
      "corrects them\n"
      ".SH SYNOPSIS\n.B trueaxis\n\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n";
  text += troff(app.get_description()) +
          "\n.PP\nFiles in and out, and every key of them, are in docs/index.md; the "
          "first half "
          "hour in docs/tutorial/first-axis.md; words and symbols in "
          "docs/reference/glossary.md.\n.SH COMMANDS\n";
  for (const DescribedCommand& command : commands_of(app)) text += command_entry(command);
  return text + ".SH EXIT STATUS\n" + troff(app.get_footer()) +
         "\n.SH ENVIRONMENT\n.TP\n\\fBNO_COLOR\\fR\nwhere it is set, the verdict has no colour\n";
}

void add_man(CLI::App* command, int& exit_code) {
  command->callback([command, &exit_code] {
    std::cout << manual(*command->get_parent());
    exit_code = done;
  });
}

}  // namespace trueaxis::cli
