// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "format/json.hpp"
#include "format/outputs.hpp"
#include "job/files/job_file.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/job.hpp"
#include "trueaxis/part_form.hpp"

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

/// What a run writes: result.json, for each diagnosed reference its diagnosis and its readings,
/// and, if there is a go, the files for controls that the job asks for and table.csv.
std::vector<ResultFile> job_files(const JobResult& result);

/// Whether the files hold a table, which is there to be run.
bool has_table(const JobResult& result);

/// "followed spindle.radial_synchronous of seat", or why it is not.
std::string inclusion_text(const Inclusion& inclusion);

/// The run for a person at a terminal: the verdict's line, fits and causes, what became of the
/// motions asked into the correction, and the correction's extremes.
std::string job_text(const JobResult& result);

/// Schema trueaxis.run/2: verdict, fits, target axis with the residual at each reference, harmonics
/// of the correction and the actuator's margin; the files written next to it, with their hashes.
std::string job_json(const JobResult& result, const std::vector<ResultFile>& beside);

/// The same without the files.
Json job_object(const JobResult& result);

/// Rows, harmonics and the actuator's margin of a correction.
Json correction_object(const Correction& correction);

/// Name of the file next to the result that holds the diagnosis of a reference.
std::string diagnosis_file(const Job& job, std::size_t reference);

/// Name of the file with its readings: measured, simulated, residual.
std::string readings_file(const Job& job, std::size_t reference);

/// A line with the schema trueaxis.residuals/1, a header, and one row per reading: row, C[deg],
/// position[mm], reading[mm], residual[um], rejected (0/1).
std::string residuals_csv(const ProbeStream& stream, const FitResult& result);

/// One row per reading: row, C[deg], Z[mm], X_M[mm], residual_before[um] of the ideal fit,
/// effect[um] of all causes, residual_after[um] with them, masked (0/1). A number that is not
/// determined is an empty cell. With `simulated` two columns more: what the virtual lathe reads off
/// the ideal fit and with all causes, simulated_before[mm] and simulated_after[mm].
std::string residuals_csv(const ProbeStream& stream, const Diagnosis& diagnosis,
                          const SimulatedReadings* simulated = nullptr);

/// As in result.json: association, its axis at both ends of the probed length, how far it is from
/// that of the job there, and why there is no u.
Json datum_axes_array(const std::vector<DatumAxis>& axes, const FitResult& used);

/// A line an association.
std::string datum_axes_text(const std::vector<DatumAxis>& axes, const FitResult& used);

/// The axis of a reference at the ends of its length: offset from the spindle axis, tilt, where to
/// tap; null where it is not known.
Json seat_axis_object(const JobResult& result, std::size_t reference);

/// How far the axes of each two seats are apart.
Json seats_apart_array(const JobResult& result);

/// The same for a terminal: lines "axis", "tap", "offset", "apart"; empty where not known.
std::string seat_axis_screen(const JobResult& result, std::size_t reference);
std::string seats_apart_screen(const JobResult& result);
/// "; 2.4 ± 0.7 µm between the axes of A and B at Z 20 mm (k = 2)": those that are furthest from
/// each other; empty where none are known.
std::string largest_distance_text(const JobResult& result);

/// As in result.json: filter, values as probed and of the part, a row a section, judgements.
Json part_form_object(const PartForm& form);

/// What a screen has of it: a line of the values, or a line a tolerance.
/// @param name of the reference; empty: the only one
std::string part_form_screen(const PartForm& form, const std::string& name);

/// The file of a diagnosis, with `form`.
std::string diagnosis_with_form(const Diagnosis& diagnosis, const PartForm& form);

/// All of it in words, with the sections.
std::string part_form_text(const PartForm& form);

/// "roundness NOT MET: RONt 8.1 ± 0.4 µm at Z = 12 mm, tolerance 5 µm (Gaussian 1-50 UPR, ISO
/// 14253-1)".
std::string judgement_text(const PartForm& form, const FormJudgement& judgement);

/// "Gaussian 1-50 UPR" or "no filter".
std::string filter_words(const FormOptions& options);

/// Whether the sections' radii change as a cone's: conicity then stands for cylindricity.
bool is_tapered(const FormResult& form);

/// A job in some ten lines for a person: the verdict, its reasons, what each reference shows, what
/// the tool does, what to do next. Lines are not broken (the command does). job_text() has the
/// rest.
std::string job_screen(const JobResult& result);

/// All that a run of the job reads and may write, into a folder.
void name_job_files(Outputs& outputs, const JobFile& file, const std::string& folder);

/// The remarks about the files of an earlier job.
struct EarlierRun {
  std::string removed, kept;
};

/// The files of a result into their folder. Tables are there only if they may be run. What an
/// earlier job wrote there and this one does not is removed if unchanged, and named if it was
/// changed since.
EarlierRun write_job_files(Outputs& outputs, const JobResult& result,
                           const std::vector<ResultFile>& files);

}  // namespace trueaxis
