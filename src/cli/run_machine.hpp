// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine_job.hpp"

namespace trueaxis::cli {

/// The job of a machine: every result into `folder`, the program only where it may be run.
int run_machine(MachineJob job, const std::string& folder, bool force);

}  // namespace trueaxis::cli
