// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "measure/files/stream_csv_metadata.hpp"

namespace trueaxis {

/// Whether a C column is wrapped: it stays within one turn, [0, turn] or [-turn/2, turn/2] up to a
/// thousandth of a turn, and jumps by more than half a turn.
bool csv_is_wrapped(const std::vector<double>& c, double turn);

/// From the numbers as they stand in the file to mm, rad (running), s and radii. What contradicts
/// is a diagnostic; nothing is changed then.
void csv_finish(const CsvHeader& header, const CsvMetadataReader& metadata,
                const StreamReadOptions& options, ProbeStream& stream, CsvDiagnostics& diagnostics);

}  // namespace trueaxis
