// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// Reads a correction table for the virtual cut: `#` lines, then a header
/// `rev,Z[mm],C[deg],X_fts[mm],X_command[mm]` (face: `rev,X[mm],C[deg],Z_fts[mm],Z_command[mm]`)
/// and rows. C may be wrapped to [0, 360) or running; it is unwrapped in the `sense` (±1) of the
/// cut.
/// @throws InputError with every diagnostic.
virtual_lathe::CutTable read_cut_table(const std::string& path, int sense);
virtual_lathe::CutTable parse_cut_table(std::string_view content, const std::string& path,
                                        int sense);

}  // namespace trueaxis
