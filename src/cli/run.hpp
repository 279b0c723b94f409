// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis::cli {

struct RunArguments {
  StreamOptions stream;  ///< `path` is the job's, or a stream's
  AssociationOptions association;
  CLI::Option* surface = nullptr;
  std::string folder;
  std::string previous;  ///< result.json of the part before; empty: none
  Results results;
  bool force = false, verbose = false, check = false;
};

/// The command of this name, with its screen and files; what it ends with.
int run(const RunArguments& options);

struct RunMachineOptions {
  std::string folder;
  bool force = false, verbose = false, check = false;
  const Results* results = nullptr;
};

/// `trueaxis run` of the job of a machine of several axes. @returns the exit code
int run_machine(MachineJob job, const RunMachineOptions& options);

}  // namespace trueaxis::cli
