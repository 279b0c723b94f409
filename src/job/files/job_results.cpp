// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_results.hpp"

#include <utility>

#include "correct/files/table_csv.hpp"
#include "correct/files/table_text.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "fit/files/fit_text.hpp"
#include "job/agreement.hpp"
#include "job/files/job_json.hpp"
#include "job/files/residuals_csv.hpp"
#include "measure/files/stream_csv.hpp"
#include "resimulate/files/comparison_text.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

std::string diagnosis_text_of(const JobResult& result, std::size_t i) {
  if (!result.diagnoses[i]) return "";
  const Diagnosis& diagnosis = *result.diagnoses[i];
  const bool again = diagnosis.verdict != DiagnosisVerdict::ideal && result.resimulations[i];
  return findings_text(diagnosis) + (again ? resimulation_line(*result.resimulations[i]) : "");
}

std::string inclusion_text(const Inclusion& i) {
  return (i.included ? "followed    " : "not followed ") + i.effect +
         (i.reference.empty() ? "" : " of " + i.reference) + (i.why.empty() ? "" : ": " + i.why) +
         "\n";
}

}  // namespace

std::vector<ProbeStream> read_streams(const Job& job) {
  std::vector<ProbeStream> streams;
  std::vector<Diagnostic> diagnostics;
  for (const JobReference& reference : job.references) {
    try {
      const StreamReading& said = reference.read;
      streams.push_back(read_stream_csv(
          reference.stream, {said.diameter, SaidBy::job, said.indication, said.nominal_radius_mm}));
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  return streams;
}

std::vector<ResultName> job_file_names(const Job& job) {
  std::vector<ResultName> names{{"result.json", "trueaxis.run"}};
  for (std::size_t i = 0; i < job.references.size(); ++i) {
    names.push_back({diagnosis_file(job, i), "trueaxis.diagnosis"});
    names.push_back({readings_file(job, i), "trueaxis.residuals"});
  }
  names.push_back({"table.csv", "trueaxis.correction"});
  return names;
}

std::vector<ResultFile> job_files(const JobResult& result) {
  std::vector<ResultFile> files{{"result.json", job_json(result)}};
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    files.push_back({diagnosis_file(result.job, i), diagnosis_json(*result.diagnoses[i])});
    files.push_back(
        {readings_file(result.job, i), residuals_csv(result.streams[i], *result.diagnoses[i],
                                                     &result.resimulations[i]->readings)});
  }
  if (result.correction && result.verdict.go())
    files.push_back({"table.csv", correction_csv(*result.correction)});
  return files;
}

std::string job_text(const JobResult& result) {
  std::string text = result.verdict.line + "\n\n";
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    text += fit_text(result.fits[i]) + diagnosis_text_of(result, i) + "\n";
  for (const Disagreement& d : result.agreement.disagreements)
    text += "references  " + how_apart(result, d) + "\n";
  for (const Inclusion& inclusion : result.inclusions) text += inclusion_text(inclusion);
  if (result.correction) text += correction_preview(*result.correction) + "\n";
  return text;
}

}  // namespace trueaxis
