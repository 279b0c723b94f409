// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/outputs.hpp"
#include "job/files/job_file.hpp"
#include "job/files/job_results.hpp"

namespace trueaxis {

/// All that a run of the job reads and may write, into a folder.
void name_job_files(Outputs& outputs, const JobFile& file, const std::string& folder);

/// What is said of the files of an earlier job.
struct EarlierRun {
  std::string removed, kept;
};

/// The files of a result into their folder. Tables stand there only when they may be run; what an
/// earlier job wrote there and this one does not goes as it was written, and is named where it was
/// changed since.
EarlierRun write_job_files(Outputs& outputs, const JobResult& result,
                           const std::vector<ResultFile>& files);

}  // namespace trueaxis
