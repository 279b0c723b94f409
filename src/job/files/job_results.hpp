// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// A file of a folder of results.
struct ResultFile {
  std::string name, text;
  std::string note{};  ///< of a file for a control: how it is rounded and how far it is off
};

/// The name of one, and its schema without the version.
struct ResultName {
  std::string name, schema;
};

/// Every file that `job_files` may give of this job.
std::vector<ResultName> job_file_names(const Job& job);

/// What a run leaves behind: result.json, of each diagnosed reference its diagnosis and its
/// readings, and, when there is a go, the files for controls that the job asks for and table.csv.
std::vector<ResultFile> job_files(const JobResult& result);

/// Whether the files hold a table, which is there to be run.
bool has_table(const JobResult& result);

/// "followed spindle.radial_synchronous of seat", or why it is not.
std::string inclusion_text(const Inclusion& inclusion);

/// The run for a person at a terminal: the verdict's line, fits and findings, what became of the
/// motions asked into the correction, and the correction's extremes.
std::string job_text(const JobResult& result);

/// Schema trueaxis.run/2: verdict, fits, target axis with what is left at each reference, harmonics
/// of the correction and the actuator's margin; the files written beside it, with their hashes.
std::string job_json(const JobResult& result, const std::vector<ResultFile>& beside);

/// The same without the files.
Json job_object(const JobResult& result);

/// Rows, harmonics and the actuator's margin of a correction.
Json correction_object(const Correction& correction);

/// Name of the file beside the result that holds the diagnosis of a reference.
std::string diagnosis_file(const Job& job, std::size_t reference);

/// Name of the file with its readings: measured, simulated, what is left.
std::string readings_file(const Job& job, std::size_t reference);

/// A line with the schema trueaxis.residuals/1, a header, and one row per reading: row, C[deg],
/// position[mm], reading[mm], residual[um], rejected (0/1).
std::string residuals_csv(const ProbeStream& stream, const FitResult& result);

/// One row per reading: row, C[deg], Z[mm], X_M[mm], residual_before[um] of the ideal surface,
/// effect[um] of all findings, residual_after[um] of the extended model, masked (0/1). A number
/// that is not determined is an empty cell. With `simulated` two columns more: what the virtual
/// lathe reads off the ideal surface and the extended model, simulated_before[mm] and
/// simulated_after[mm].
std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis,
                          const SimulatedReadings* simulated = nullptr);

}  // namespace trueaxis
