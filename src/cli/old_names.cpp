// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include "cli/program.hpp"

namespace trueaxis::cli {
namespace {

struct Renamed {
  const char *old_name, *new_name;
};

constexpr std::array commands{Renamed{"associate", "fit"},
                              Renamed{"correct", "table"},
                              Renamed{"calibrate", "machine calibrate"},
                              Renamed{"compensate", "machine compensate"},
                              Renamed{"pose", "machine pose"},
                              Renamed{"axes", "machine inverse"},
                              Renamed{"errors", "machine errors"},
                              Renamed{"locate", "setup locators"},
                              Renamed{"datum", "setup datums"},
                              Renamed{"plan", "study plan"},
                              Renamed{"sweep", "study sweep"},
                              Renamed{"axis-bias", "study axis-bias"}};

constexpr std::array options{Renamed{"--ball-radius", "--ball-radius-mm"},
                             Renamed{"--nominal-radius", "--nominal-radius-mm"},
                             Renamed{"--noise", "--noise-um"},
                             Renamed{"--arcs", "--arcs-mm"},
                             Renamed{"--angles", "--angles-deg"},
                             Renamed{"--k", "--coverage-factor"},
                             Renamed{"--distances", "--residuals"}};

/// Their machine was the first word, without an option.
constexpr std::array<std::string_view, 4> of_a_machine{"calibrate", "pose", "axes", "errors"};

using Words = std::vector<std::string>;

std::string note(const std::string& old_name, const std::string& new_name) {
  return "trueaxis: " + old_name + " is now " + new_name +
         "; the old name works until the next release\n";
}

bool given(const Words& words, std::string_view option) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return word == option || word.starts_with(std::string(option) + '=');
  });
}

/// "sweep.toml", "../dh": a file, and no command that is misspelled.
bool is_place(const std::string& word) {
  return !word.starts_with('-') && word.find_first_of("./") != std::string::npos;
}

/// The machine's file, for which there is an option now.
void name_machine(Words& words) {
  for (auto at = words.begin() + 1; at != words.end(); ++at) {
    const bool behind_an_option = at != words.begin() + 1 && (at - 1)->starts_with("-") &&
                                  *(at - 1) != "--large-errors" && *(at - 1) != "--check";
    if (at->starts_with('-') || behind_an_option) continue;
    words.insert(at, "--machine");
    return;
  }
}

/// The command of today, empty where the word is one.
std::string new_command(const Words& words) {
  const std::string& word = words.front();
  if (const auto found = std::ranges::find(commands, std::string_view(word), &Renamed::old_name);
      found != commands.end())
    return found->new_name;
  if (word == "diagnose" && given(words, "--machine")) return "machine diagnose";
  if (word == "machine" && words.size() > 1 &&
      (is_place(words[1]) || words[1] == "-o" || words[1] == "--output"))
    return "machine import";
  return "";
}

void rename_command(Words& words, std::string& notes) {
  const std::string name = new_command(words);
  if (name.empty()) return;
  notes += note(words.front(), name);
  if (std::ranges::find(of_a_machine, words.front()) != of_a_machine.end() &&
      !given(words, "--machine"))
    name_machine(words);
  const std::size_t blank = name.find(' ');
  words.front() = name.substr(0, blank);
  if (blank != std::string::npos) words.insert(words.begin() + 1, name.substr(blank + 1));
}

/// The folder of `init` is its argument.
void rename_folder(Words& words, std::string& notes) {
  if (words.front() != "init") return;
  for (const char* const old_name : {"-o", "--output"})
    if (const auto at = std::ranges::find(words, old_name); at != words.end()) {
      notes += note("init " + *at + " DIR", "init DIR");
      words.erase(at);
    }
}

/// `effects --json` printed.
void rename_json(Words& words, std::string& notes) {
  if (words.front() != "effects") return;
  const auto at = std::ranges::find(words, "--json");
  if (at == words.end() ||
      (at + 1 != words.end() && (*(at + 1) == "-" || !(at + 1)->starts_with('-'))))
    return;
  notes += note("effects --json", "effects --json -");
  words.insert(at + 1, "-");
}

void rename_options(Words& words, std::string& notes) {
  for (std::string& word : words)
    for (const auto& [old_name, new_name] : options) {
      if (word != old_name && !word.starts_with(std::string(old_name) + '=')) continue;
      notes += note(old_name, new_name);
      word = new_name + word.substr(std::string_view(old_name).size());
    }
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i - 1] == "--criterion" && words[i] == "orthogonal") {
      notes += note("--criterion orthogonal", "--criterion gaussian");
      words[i] = "gaussian";
    }
}

}  // namespace

NewNames with_new_names(Words words) {
  NewNames out{std::move(words), ""};
  if (out.words.empty()) return out;
  rename_command(out.words, out.notes);
  rename_folder(out.words, out.notes);
  rename_json(out.words, out.notes);
  rename_options(out.words, out.notes);
  return out;
}

}  // namespace trueaxis::cli
