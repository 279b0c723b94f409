// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "recording/import.hpp"

namespace trueaxis {

/// The read-out of an axis against a scale or laser as `calibrate` reads it: `# kind: axis`.
struct ImportedReadOut {
  std::vector<std::string> notes;  ///< what was read and what was not used, in sentences
  std::string text;                ///< trueaxis.measurement/1; the digits as they were in the file
  std::size_t rows = 0;
};

/// Reads a table of positions with either actual positions or errors (actual less commanded, ISO
/// 230-2) of an axis, X Y Z A B C. Columns by their names, or as `options.columns` says:
/// "command=1[mm],error=3[um]".
/// @throws InputError with everything that is wrong or not clear, and the command that would read
/// it
ImportedReadOut import_read_out(const std::string& path, char axis,
                                const RecordingOptions& options = {});

}  // namespace trueaxis
