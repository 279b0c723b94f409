// SPDX-License-Identifier: Apache-2.0
#include "cli/run.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

#include "cli/earlier_table.hpp"
#include "cli/guarded.hpp"
#include "format/file.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "report/report.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

int exit_code_of(const JobResult& result) {
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  return !fitted ? numerical : result.verdict.go() ? done : refused;
}

int execute(const std::string& path, const std::filesystem::path& folder) {
  if (std::error_code error; exists(folder, error) && !is_directory(folder, error))
    throw InputError(folder.string(), "is no folder: name one for the results");
  const auto in_folder = [&](const std::string& name) { return (folder / name).string(); };
  remove_earlier_table(in_folder("table.csv"));
  const Job job = read_job_toml(path);
  const JobResult result = run_job(job, read_streams(job));
  for (const FitResult& fit : result.fits) {
    if (fit.status == FitStatus::too_few)
      throw InputError(fit.source, fit.message + ": probe more");
  }
  std::vector<ResultFile> results = job_files(result);
  results.insert(results.begin() + 1, {"report.html", render_report(result)});
  std::vector<FileContent> files;
  for (const ResultFile& file : results) files.push_back({in_folder(file.name), file.text});
  write_files(files);
  std::cout << job_text(result);
  if (results.back().name == "table.csv") {
    std::cout << "table   " << files.back().path << '\n';
  } else if (result.correction) {
    std::cout << "table   not written: " << result.verdict.line << '\n';
  }
  std::cout << "result  " << files[0].path << "\nreport  " << files[1].path << '\n';
  return exit_code_of(result);
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
