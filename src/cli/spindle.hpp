// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace trueaxis::cli {

/// `trueaxis spindle`: form of the part and error motion of the spindle.
void add_spindle(CLI::App& app, int& exit_code);

}  // namespace trueaxis::cli
