// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/correction.hpp"

namespace trueaxis {

/// The correction table: a `# key: value` header and rows. The header has the checksum of all below
/// it, units, C zero and sense, Z datum, tool, speed and its limit, actuator, stroke used,
/// predicted following error and target axis. The rows are
/// `rev,Z[mm],C[deg],X_fts[mm],X_command[mm]`, for a face
/// `rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]`. C in [0, 360). Z and C have 6 decimals, the
/// correction 7 (0.1 nm).
std::string correction_csv(const Correction& correction);

/// The header of the correction table alone, every line with its `#`.
std::string correction_header(const Correction& correction);

/// Extremes, harmonics and the actuator's margin as text, µm and degrees.
std::string correction_preview(const Correction& correction);

}  // namespace trueaxis
