// SPDX-License-Identifier: Apache-2.0
#include "cli/probing_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/counted.hpp"
#include "cli/options.hpp"
#include "format/file.hpp"
#include "nc/probing/files/probing_limits_toml.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

nc::ProbingControl control_of(const std::string& word) {
  if (word == "fanuc") return nc::ProbingControl::fanuc;
  if (word == "heidenhain") return nc::ProbingControl::heidenhain;
  return word == "siemens" ? nc::ProbingControl::siemens : nc::ProbingControl::linuxcnc;
}

constexpr const char* nothing_to_write =
    "no measurement that control and probe can make alone tells more: there is no program to write";

constexpr std::size_t longest_of_reference = 12;  // controls take names of 24 letters

/// A control takes letters, digits, '_' and '-' in the name of a log.
std::string log_name(const std::string& output) {
  if (output == "-") return "probe";
  std::string name = std::filesystem::path(output).stem().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-') c = '_';
  return name;
}

}  // namespace

void ProbingOption::add_to(CLI::App& command) {
  add_option(command, "--control", control_, one_of({"linuxcnc", "fanuc", "siemens", "heidenhain"}),
             "control of the probing program");
  command.add_option("--limits", limits_file_, "what the program must keep to (TOML)")
      ->type_name("FILE");
  command.add_flag("--air-run", dry_run_,
                   "a dry run: the program keeps off the part and logs nothing");
}

void ProbingOption::read(const Results& results, Outputs& outputs) {
  if (!asked()) {
    if (!limits_file_.empty() || dry_run_ || results.asked("--output"))
      throw CLI::RequiredError("--control");
    return;
  }
  if (!results.asked("--output")) throw CLI::RequiredError("--output");
  if (limits_file_.empty()) throw CLI::RequiredError("--limits");
  outputs.reads(limits_file_);
  limits_ = parse_probing_limits(read_file(limits_file_), limits_file_);
}

nc::ProbingProgram ProbingOption::write(std::span<const nc::ProbingPlan> plans,
                                        const std::string& output) const {
  return nc::write_probing(plans, limits_, control_of(control_), log_name(output), dry_run_,
                           limits_file_);
}

std::optional<nc::ProbingPlan> ProbingOption::first_driven(
    const std::vector<nc::ProbingPlan>& plans) const {
  std::optional<InputError> first;
  for (const nc::ProbingPlan& plan : plans) {
    // It reads at standstill, so the sense of C and a pass at standstill tell nothing.
    const auto turns_like_the_first = [&](const nc::ProbingPass& pass) {
      return pass.turns * plan.passes.front().turns > 0.0;
    };
    if (limits_.kind == nc::ProbeKind::touch &&
        !std::ranges::all_of(plan.passes, turns_like_the_first))
      continue;
    try {
      write({&plan, 1}, "-");
      return plan;
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  if (first) throw InputError(*first);
  return {};
}

nc::ProbingProgram ProbingOption::write_first(const std::vector<nc::ProbingPlan>& plans,
                                              const std::string& output) const {
  const std::optional<nc::ProbingPlan> plan = first_driven(plans);
  if (!plan) throw Refusal(nothing_to_write);
  return write({&*plan, 1}, output);
}

nc::ProbingProgram ProbingOption::write_each(
    const std::vector<std::pair<std::string, std::vector<nc::ProbingPlan>>>& references,
    const std::string& output, std::string& what) const {
  std::vector<nc::ProbingPlan> driven;
  std::string left;
  for (std::size_t i = 0; i < references.size(); ++i) {
    auto [name, plans] = references[i];
    for (nc::ProbingPlan& plan : plans) {
      plan.what = "reference " + name + ": " + plan.what;
      plan.log = std::to_string(i + 1) + "_" + log_name(name).substr(0, longest_of_reference);
    }
    if (std::optional<nc::ProbingPlan> plan = first_driven(plans)) {
      what += "  log " + log_name(output) + "_" + plan->log + ": " + plan->what + "\n";
      driven.push_back(std::move(*plan));
    } else {
      left += "  " + name + ": no measurement that control and probe can make alone tells more\n";
    }
  }
  if (driven.empty()) throw Refusal(nothing_to_write);
  what += left;
  return write(driven, output);
}

std::string ProbingOption::line(const nc::ProbingProgram& program, const std::string& output) {
  if (output == "-") return "";
  return fmt::format("{}  ({}, about {:.1f} min)\n", output, counted(program.readings, "reading"),
                     program.minutes);
}

}  // namespace trueaxis::cli
