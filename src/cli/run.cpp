// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "trueaxis/base/error.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/fit_text.hpp"
#include "trueaxis/io/job_json.hpp"
#include "trueaxis/io/job_toml.hpp"
#include "trueaxis/io/stream_csv.hpp"
#include "trueaxis/io/table_csv.hpp"
#include "trueaxis/job/job.hpp"
#include "trueaxis/report/report.hpp"

namespace trueaxis::cli {
namespace {

/// All streams, with the diagnostics of all of them at once.
std::vector<ProbeStream> read_streams(const Job& job) {
  std::vector<ProbeStream> streams;
  std::vector<Diagnostic> diagnostics;
  for (const JobReference& reference : job.references) {
    try {
      const StreamReading& said = reference.read;
      streams.push_back(
          read_stream_csv(reference.stream, {said.diameter, said.indication, said.nominal_radius_mm}));
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  return streams;
}

int execute(const std::string& path, const std::filesystem::path& folder) {
  const Job job = read_job_toml(path);
  const JobResult result = run_job(job, read_streams(job));
  for (const FitResult& fit : result.fits) {
    if (fit.status == FitStatus::too_few) throw InputError(fit.source, fit.message + ": probe more");
  }
  const std::filesystem::path table = folder / "table.csv";
  std::cout << result.verdict.line << "\n\n";
  for (const FitResult& fit : result.fits) std::cout << fit_text(fit) << '\n';
  if (result.correction) std::cout << correction_preview(*result.correction) << '\n';
  // A table stands in the folder only when it may be run: one of an earlier job goes first.
  std::error_code ignored;
  std::filesystem::remove(table, ignored);
  if (result.correction && result.verdict.go) {
    write_file(table.string(), correction_csv(*result.correction));
    std::cout << "table   " << table.string() << '\n';
  } else if (result.correction) {
    std::cout << "table   not written: " << result.verdict.line << '\n';
  }
  write_file((folder / "result.json").string(), job_json(result));
  write_file((folder / "report.html").string(), render_report(result));
  std::cout << "result  " << (folder / "result.json").string() << '\n'
            << "report  " << (folder / "report.html").string() << '\n';
  const bool all_fitted =
      std::ranges::all_of(result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  return !all_fitted ? numerical : result.verdict.go ? done : refused;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "the whole job: fit, correction, report");
  auto job = std::make_shared<std::string>();
  auto folder = std::make_shared<std::string>();
  command->add_option("job", *job, "job file (TOML)")->required();
  command->add_option("-o,--output", *folder, "folder for table.csv, result.json and report.html")->required();
  command->callback([=, &exit_code] { exit_code = execute(*job, *folder); });
}

}  // namespace trueaxis::cli
