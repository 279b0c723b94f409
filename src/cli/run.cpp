// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/earlier_table.hpp"
#include "cli/job_streams.hpp"
#include "cli/resimulation.hpp"
#include "correct/files/table_csv.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "fit/files/fit_text.hpp"
#include "format/file.hpp"
#include "job/files/job_json.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/residuals_csv.hpp"
#include "report/report.hpp"
#include "resimulate/files/comparison_json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

void print(const JobResult& result) {
  std::cout << result.verdict.line << "\n\n";
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    std::cout << fit_text(result.fits[i]);
    const auto& diagnosis = result.diagnoses[i];
    if (diagnosis)
      std::cout << findings_text(*diagnosis);
    else if (result.streams[i].kind == StreamKind::face)
      std::cout << "diagnosis   none: a face is not diagnosed\n";
    if (diagnosis && diagnosis->verdict != DiagnosisVerdict::ideal && result.resimulations[i])
      std::cout << resimulation_line(*result.resimulations[i]);
    std::cout << '\n';
  }
  for (const Inclusion& i : result.inclusions) {
    std::cout << (i.included ? "followed    " : "not followed ") << i.effect
              << (i.reference.empty() ? "" : " of " + i.reference)
              << (i.why.empty() ? "" : ": " + i.why) << '\n';
  }
  if (result.correction) std::cout << correction_preview(*result.correction) << '\n';
}

/// Each diagnosed reference's diagnosis and readings, in turn.
std::vector<std::string> reference_files(JobResult& result) {
  std::vector<std::string> diagnoses, texts;
  for (const auto& diagnosis : result.diagnoses)
    diagnoses.push_back(diagnosis ? diagnosis_json(*diagnosis) : "");
  result.resimulations = resimulate_job(result, diagnoses);
  judge_resimulations(result);
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    texts.push_back(std::move(diagnoses[i]));
    texts.push_back(
        residuals_csv(result.streams[i], *result.diagnoses[i], &result.resimulations[i]->readings));
  }
  return texts;
}

/// The table only when it may be run.
void write(JobResult& result, const std::filesystem::path& folder) {
  const std::vector<std::string> texts = reference_files(result);
  const bool tabled = result.correction && result.verdict.go;
  const std::string json = job_json(result), report = render_report(result),
                    table = tabled ? correction_csv(*result.correction) : "";
  std::vector<FileContent> files{{(folder / "result.json").string(), json},
                                 {(folder / "report.html").string(), report}};
  for (std::size_t i = 0, next = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    files.push_back({(folder / diagnosis_file(result, i)).string(), texts[next++]});
    files.push_back({(folder / readings_file(result, i)).string(), texts[next++]});
  }
  if (tabled) files.push_back({(folder / "table.csv").string(), table});
  write_files(files);
  print(result);
  if (tabled) {
    std::cout << "table   " << files.back().path << '\n';
  } else if (result.correction) {
    std::cout << "table   not written: " << result.verdict.line << '\n';
  }
  std::cout << "result  " << files[0].path << "\nreport  " << files[1].path << '\n';
}

int execute(const std::string& path, const std::filesystem::path& folder) {
  if (std::error_code error; exists(folder, error) && !is_directory(folder, error))
    throw InputError(folder.string(), "is no folder: name one for the results");
  remove_earlier_table((folder / "table.csv").string());
  const Job job = read_job_toml(path);
  JobResult result = run_job(job, read_streams(job));
  for (const FitResult& fit : result.fits) {
    if (fit.status == FitStatus::too_few)
      throw InputError(fit.source, fit.message + ": probe more");
  }
  write(result, folder);
  const bool all_fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  return !all_fitted ? numerical : result.verdict.go ? done : refused;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("run", "the whole job: fit, diagnosis, correction, report");
  auto job = std::make_shared<std::string>();
  auto folder = std::make_shared<std::string>();
  command->add_option("job", *job, "job file (TOML)")->required();
  command->add_option("-o,--output", *folder, "folder for table.csv, result.json and report.html")
      ->required();
  command->callback([=, &exit_code] { exit_code = execute(*job, *folder); });
}

}  // namespace trueaxis::cli
