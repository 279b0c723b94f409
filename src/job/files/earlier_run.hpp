// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "job/files/job_results.hpp"

namespace trueaxis {

/// A file that a run wrote, as its result.json names it under `files`.
struct WrittenFile {
  std::string name, hash;  ///< in the folder of the results; content_hash() of what was written
};

/// What the run that left `result_path` wrote beside it and `now` does not name; empty where there
/// is no such result. Names that are no plain ones are passed over.
std::vector<WrittenFile> files_of_earlier_run(const std::string& result_path,
                                              const std::vector<ResultFile>& now);

}  // namespace trueaxis
