// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/run_machine.hpp"
#include "cli/stream_options.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/machine/files/machine_job_toml.hpp"
#include "report/report.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

int exit_code_of(const JobResult& result) {
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  return !fitted ? numerical : result.verdict.go() ? done : refused;
}

struct Options {
  std::string job, folder;
  bool force = false;
};

int execute(const Options& options) {
  const std::string content = read_file(options.job);
  if (is_machine_job(content, options.job))
    return run_machine(read_machine_job_toml(content, options.job), options.folder, options.force);
  const Job job = read_job_toml(content, options.job);
  std::vector<ProbeStream> streams = read_streams(job);
  Outputs outputs(options.force);
  outputs.reads(options.job);
  for (const JobReference& reference : job.references) outputs.reads(reference.stream);
  outputs.into(options.folder);
  for (const ResultName& file : job_file_names(job))
    outputs.may_write_in_folder(file.name, file.schema);
  outputs.may_write_in_folder("report.html", "trueaxis.report");
  outputs.check();

  const JobResult result = run_job(job, std::move(streams));
  std::ranges::for_each(result.fits, expect_enough_readings);
  std::vector<ResultFile> files = job_files(result);
  files.insert(files.begin() + 1, {"report.html", render_report(result)});
  for (const ResultFile& file : files) outputs.write(outputs.in_folder(file.name), file.text);
  const std::string table = outputs.in_folder("table.csv");
  const bool tabled = files.back().name == "table.csv";
  if (!tabled) outputs.remove_earlier(table);  // one stands there only when it may be run
  outputs.commit();
  std::cout << job_text(result);
  if (tabled) {
    std::cout << "table   " << table << '\n';
  } else if (result.correction) {
    std::cout << "table   not written: " << result.verdict.line << '\n';
  }
  std::cout << "result  " << outputs.in_folder("result.json") << "\nreport  "
            << outputs.in_folder("report.html") << '\n';
  if (!result.refused.empty()) std::cerr << "refused: " << result.refused << '\n';
  return exit_code_of(result);
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "run",
      "the whole job: of a lathe fit, diagnosis, correction, report; of a machine "
      "of several axes diagnosis, errors, program, report");
  auto options = std::make_shared<Options>();
  command->add_option("job", options->job, "job file (TOML)")->required();
  command
      ->add_option("-o,--output", options->folder,
                   "folder for table.csv or the new program, result.json and report.html, made if "
                   "need be")
      ->required()
      ->check(a_place());
  add_force(*command, options->force);
  command->callback([=, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
