// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// All streams of a job. @throws InputError with the diagnostics of all of them at once.
std::vector<ProbeStream> read_streams(const Job& job);

/// A file of a folder of results.
struct ResultFile {
  std::string name, text;
};

/// The name of one, and its schema without the version.
struct ResultName {
  std::string name, schema;
};

/// Every file that `job_files` may give of this job.
std::vector<ResultName> job_file_names(const Job& job);

/// What a run leaves behind: result.json, of each diagnosed reference its diagnosis and its
/// readings, and table.csv when there is a go.
std::vector<ResultFile> job_files(const JobResult& result);

/// The run for a person at a terminal: the verdict's line, fits and findings, what became of the
/// motions asked into the correction, and the correction's extremes.
std::string job_text(const JobResult& result);

}  // namespace trueaxis
