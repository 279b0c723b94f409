// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trueaxis::cli {

/// The program with the words after its name. It writes to standard output and standard error.
/// @returns the exit code @throws as the library does: see guarded()
int run_program(const std::vector<std::string>& words);

}  // namespace trueaxis::cli
