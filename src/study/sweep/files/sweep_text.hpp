// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// For the terminal: a table for each cell, of many cells the ratios only.
std::string sweep_text(const study::Sweep& sweep, const study::Summary& summary);

}  // namespace trueaxis
