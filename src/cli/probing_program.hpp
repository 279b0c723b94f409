// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cli/results.hpp"
#include "format/outputs.hpp"
#include "nc/probing/probing.hpp"

namespace trueaxis::cli {

/// `--control`, `--limits`, `--air-run`: the plan as a program of a control.
class ProbingOption {
 public:
  /// `--output` is where it goes.
  void add_to(CLI::App& command);

  bool asked() const { return !control_.empty(); }
  /// Names what is read. @throws InputError with all that is wrong with the limits
  void read(const Results& results, Outputs& outputs);
  /// Plans one after the other. @throws InputError with every reason why one cannot be driven
  nc::ProbingProgram write(std::span<const nc::ProbingPlan> plans, const std::string& output) const;
  /// The first of several that the probe at hand can read; none: there are none that it can.
  /// @throws InputError with the reasons of the first if it cannot be driven, and no other can
  std::optional<nc::ProbingPlan> first_driven(const std::vector<nc::ProbingPlan>& plans) const;
  /// The one that first_driven() gives. @throws Refusal if there is none
  nc::ProbingProgram write_first(const std::vector<nc::ProbingPlan>& plans,
                                 const std::string& output) const;
  /// One program of first_driven() of every reference of a job that has one. @param what the screen
  /// says of the others, and of the logs. @throws Refusal if none has
  nc::ProbingProgram write_each(
      const std::vector<std::pair<std::string, std::vector<nc::ProbingPlan>>>& references,
      const std::string& output, std::string& what) const;
  /// A line of the screen: where the program went, and what it takes.
  static std::string line(const nc::ProbingProgram& program, const std::string& output);

 private:
  std::string control_, limits_file_;
  bool dry_run_ = false;
  nc::ProbingLimits limits_;
};

}  // namespace trueaxis::cli
