// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// One row a cell and quantity, with the axes' values; the same bytes whoever ran the sweep.
std::string sweep_csv(const study::Sweep& sweep, const study::Summary& summary);

/// One row a cell: seconds of one thread and repeats a second; not reproducible.
std::string sweep_timing_csv(const study::Sweep& sweep, const study::Summary& summary);

/// Schema trueaxis.sweep/1: input hash, seed, options, cells and rows; no times.
std::string sweep_json(const study::Sweep& sweep, const study::Summary& summary);

/// For the terminal: a table for each cell, of many cells the ratios only.
std::string sweep_text(const study::Sweep& sweep, const study::Summary& summary);

}  // namespace trueaxis
