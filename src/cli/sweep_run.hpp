// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/results.hpp"
#include "studies/published/published.hpp"
#include "study/sweep/block.hpp"

namespace trueaxis::cli {

/// Runs the blocks it is given, in any order, and hands over each when it is done.
using BlockRunner = std::function<void(const std::vector<study::Block>&,
                                       const std::function<void(study::BlockResult&&)>&)>;

/// Looks at every place that a sweep would write, and says what it would do. @returns the exit code
int check_sweep(const study::PublishedSweep& file, const std::string& folder,
                const Results& results);

/// What the journal in `folder` leaves to do, done by `runner`; then sweep.csv, sweep.json,
/// timing.csv, report.html and, for published runs, published.json there, and the table on
/// standard output. Progress on a terminal. Without a folder no file but that of `--json` is
/// written. `results` have force, and `--json` if the command has it.
/// @throws InputError before anything is written where a place must not or cannot be written;
void run_sweep(const study::PublishedSweep& file, const std::string& folder, const Results& results,
               const BlockRunner& runner);

}  // namespace trueaxis::cli
