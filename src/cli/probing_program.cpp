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

nc::ProbingProgram ProbingOption::write(nc::ProbingPlan plan, const std::string& output) const {
  return nc::write_probing(plan, limits_, control_of(control_), log_name(output), dry_run_,
                           limits_file_);
}

nc::ProbingProgram ProbingOption::write_first(const std::vector<nc::ProbingPlan>& plans,
                                              const std::string& output) const {
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
      return write(plan, output);
    } catch (const InputError& error) {
      if (!first) first = error;
    }
  }
  if (first) throw InputError(*first);
  throw Refusal(
      "no measurement that control and probe can make alone tells more: there is no program to "
      "write");
}

std::string ProbingOption::line(const nc::ProbingProgram& program, const std::string& output) {
  if (output == "-") return "";
  return fmt::format("{}  ({}, about {:.1f} min)\n", output, counted(program.readings, "reading"),
                     program.minutes);
}

}  // namespace trueaxis::cli
