// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/seats.hpp"
#include "recording/import.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// Where readings are, and what the job or the command says of them that their file does not.
struct StreamFile {
  std::string path;
  RecordingOptions said{};
  ZRange z{};  ///< readings at other Z are passed over
};

/// The cut as it was probed again.
struct VerificationFile {
  StreamFile stream;
  std::string table;  ///< that the part was cut with
  StreamFile form{};  ///< of the finished cut, measured elsewhere in the part's C; no path: none
};

/// A job as it is written down: what run_job() gets, and the files it comes from.
struct JobFile {
  std::string path;
  Job job{};
  std::vector<StreamFile> streams{};     ///< one per reference
  std::vector<std::string> templates{};  ///< that the files for controls are made by
  std::optional<VerificationFile> verification{};
};

/// @throws InputError as read_recording() does
ProbeStream read_stream(const StreamFile& file);

/// All streams of a job. @throws InputError with the diagnostics of all of them at once.
std::vector<ProbeStream> read_streams(const JobFile& file);

}  // namespace trueaxis
