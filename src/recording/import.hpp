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

}  // namespace trueaxis
