// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/machine_options.hpp"
#include "cli/results.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis::cli {

/// Options of `machine diagnose` and `advise --machine`.
struct MachineDiagnosed {
  MachineOptions machine;
  std::vector<std::string> data;  ///< measurements; none: a plan before any
  std::string program;            ///< a part on which the harm is weighed
  double false_alarm = 0.01;
  double coverage_factor = 2.0;
  double noise_um = -1.0;  ///< of a first plan's readings; below 0: as usual
  bool verbose = false, check = false;

  /// @returns `--machine`
  CLI::Option* add_to(CLI::App& command);

  /// Diagnoses the data and writes what is asked for. @returns the exit code
  int diagnose(const Results& results) const;
  /// Prints the next measurement and what every other would show. @returns the exit code
  int advise(const Results& results) const;
};

/// No option for a machine goes with a stream. @throws CLI::ValidationError
void expect_one_stream(const CLI::App& command, std::size_t streams);

/// The same of a machine's job: its measurements, what is known, and its program if it has one.
/// @param outputs checked
int advise_machine_job(const MachineJob& job, const Results& results, Outputs& outputs,
                       bool verbose);

}  // namespace trueaxis::cli
