// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/resimulation.hpp"

namespace trueaxis {

/// What every file says of a comparison: readings, discrepancies, largest lines.
Json comparison_object(const Comparison& comparison);

/// Schema trueaxis.comparison/2: measured against simulated, before and after.
/// @param diagnosis, stream the files it was made from
std::string comparison_json(const Comparison& comparison, const std::string& diagnosis,
                            const ProbeStream& stream);

/// In a line: the rest of the discrepancy, or why it was not simulated again.
std::string resimulation_line(const Resimulation& again);

/// The same as a table.
std::string comparison_text(const Comparison& comparison);

}  // namespace trueaxis
