// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// One row a cell and quantity, with the axes' values; the same bytes whoever ran the sweep.
std::string sweep_csv(const study::Sweep& sweep, const study::Summary& summary);

/// One row a cell: seconds of one thread and repeats a second; not reproducible.
std::string sweep_timing_csv(const study::Sweep& sweep, const study::Summary& summary);

}  // namespace trueaxis
