// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/results.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis::cli {

struct RunMachineOptions {
  std::string folder;
  bool force = false, verbose = false, check = false;
  const Results* results = nullptr;
};

/// `trueaxis run` of the job of a machine of several axes. @returns the exit code
int run_machine(MachineJob job, const RunMachineOptions& options);

}  // namespace trueaxis::cli
