// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/machine_job.hpp"

namespace trueaxis {

/// Whether a job is one of a machine: it has a table [machine], or one that only such a job has.
/// @throws InputError if it is no TOML
bool is_machine_job(std::string_view content, const std::string& path);

/// Reads a job of a machine (docs/machine_job.md) and every file that it names.
/// @throws InputError with every diagnostic of all of them
MachineJob read_machine_job_toml(std::string_view content, const std::string& path);

}  // namespace trueaxis
