// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
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
  /// @throws InputError with every reason why the plan cannot be driven
  nc::ProbingProgram write(nc::ProbingPlan plan, const std::string& output) const;
  /// The same for the first of several that the probe at hand can read.
  /// @throws InputError with the reasons of the first if it can read none
  nc::ProbingProgram write_first(const std::vector<nc::ProbingPlan>& plans,
                                 const std::string& output) const;
  /// A line of the screen: where the program went, and what it takes.
  static std::string line(const nc::ProbingProgram& program, const std::string& output);

 private:
  std::string control_, limits_file_;
  bool dry_run_ = false;
  nc::ProbingLimits limits_;
};

}  // namespace trueaxis::cli
