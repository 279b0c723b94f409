// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/resimulation.hpp"

namespace trueaxis {

/// In a line: what is left of the discrepancy, or why it was not simulated again.
std::string resimulation_line(const Resimulation& again);

/// The same as a table.
std::string comparison_text(const Comparison& comparison);

}  // namespace trueaxis
