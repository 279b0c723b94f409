// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The files that a go would write, the job's in its order and then table.csv, each as its control
/// reads it (Eq. 120a).
/// @param result with a correction and its control_files
std::vector<CutFile> cut_files(const JobResult& result);

/// The key of a file, or of the cut, with which it would add `allowed_mm` at most, tried; what else
/// to do where there is none.
std::string what_would_do(const JobResult& result, const CutFile& file, double allowed_mm);

/// What the rows of the table may be off in between, anywhere: a tenth of the tolerance; without
/// one, a tenth of the following error that the job accepts. mm
double allowed_between_rows_mm(const JobResult& result);

/// How far off straight lines between rows are and with how many rows less than allowed; empty:
/// they are within that.
std::string coarse_rows(const JobResult& result);

}  // namespace trueaxis
