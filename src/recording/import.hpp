// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "measure/files/stream_csv.hpp"

namespace trueaxis {

/// What a caller says of a file of another program.
struct RecordingOptions {
  std::string columns;   ///< "X=Diameter,C=Angle(°),Z=3[mm]"; empty: as the names tell
  std::size_t skip = 0;  ///< lines at the beginning that are not looked at
  StreamReadOptions read{};

  bool says_anything() const { return !columns.empty() || skip > 0; }
};

/// A recording of another program as a stream of TrueAxis: its text, and how it was read. Numbers
/// keep the digits of the file, except those computed from several.
struct ImportedRecording {
  std::string producer;            ///< what the file was recognised as
  std::vector<std::string> notes;  ///< what was read, passed over and assumed, in sentences
  std::string text;                ///< `trueaxis.stream/1`
  ProbeStream stream;
};

/// Reads spreadsheets' tables (any separator, decimal commas, titles, rows of units, remarks),
/// LinuxCNC's PROBEOPEN and halsampler files, DPRNT, camonitor logs and TwinCAT Scope exports.
///
/// @throws InputError with everything that is wrong, one line per kind. If something is not clear
/// (a column, a unit, radius or diameter), it has the command that would read the file.
ImportedRecording import_recording(const std::string& path, const RecordingOptions& options = {});

/// A stream of TrueAxis (stream.md), or else, if all of it is clear, a recording of another
/// program. `ProbeStream::read_as` then says how it was read. @throws InputError as
/// read_stream_csv() or import_recording() do
ProbeStream read_recording(const std::string& path, const RecordingOptions& options = {});

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
