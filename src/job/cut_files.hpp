// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The files that a go would write, the job's in its order and then table.csv, each as its control
/// reads it (Eq. 120a).
/// @param job with a correction and its control_files
std::vector<CutFile> cut_files(const PlannedJob& job);

/// The key of a file, or of the cut, with which it would add `allowed_mm` at most, tried; what else
/// to do where there is none.
Reason what_would_do(const PlannedJob& job, const CutFile& file, double allowed_mm);

/// What the rows of the table may be off in between, anywhere: a tenth of the tolerance; without
/// one, a tenth of the following error that the job accepts. mm
double allowed_between_rows_mm(const PlannedJob& job);

/// What table.csv adds with a control that makes this of its rows.
CutFile table_file(const Correction& correction, Interpolation by);

/// What is more than allowed off between the rows, of what the control may do there, and how many
/// rows would do.
Reasons coarse_rows(const PlannedJob& job);

}  // namespace trueaxis
