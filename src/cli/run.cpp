// SPDX-License-Identifier: Apache-2.0
#include "cli/run.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/diagnostics.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "job/datum_axes.hpp"
#include "job/files/feedback_files.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "job/files/stream_job.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "job/machine_loop.hpp"
#include "report/report.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

int exit_code_of_job(const JobResult& result) {
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  if (!fitted) return numerical;
  const bool met = forms_met(result) && !coaxiality_of_cut_not_met_mm(result);
  return result.verdict.go() && met ? done : refused;
}

/// "shaft_result" of data/shaft.toml, where the command is run.
std::string default_folder(const std::string& path) {
  return path == "-" ? "result" : std::filesystem::path(path).stem().string() + "_result";
}

void print(const JobResult& result, const Outputs& outputs, const std::vector<ResultFile>& files,
           const EarlierRun& earlier, bool verbose) {
  if (verbose)
    std::cout << job_text(result);
  else
    print_screen(job_screen(result));
  if (has_table(result))
    std::cout << "table  " << outputs.in_folder("table.csv") << '\n';
  else if (result.correction)
    std::cout << "table  not written: " << verdict_line(result) << '\n';
  for (const ResultFile& file : files)
    if (!file.note.empty())
      std::cout << "file   " << outputs.in_folder(file.name) << ": " << file.note << '\n';
  std::cout << earlier.removed << "report " << outputs.in_folder("report.html")
            << ", next to it result.json\n";
  if (!result.refused.empty()) std::cerr << "refused: " << result.refused << '\n';
  std::cerr << earlier.kept;
}

int run_lathe(JobFile file, const RunArguments& options, bool of_stream) {
  Job& job = file.job;
  const bool surface_known = !of_stream || options.surface->count() > 0;
  if (!surface_known) job.references.front().name = "SURFACE";  // until the readings tell
  Outputs outputs(options.force);
  std::vector<ProbeStream> streams;
  const auto read = [&] {
    streams = read_streams(file);
    if (of_stream && states_bore(streams.front())) job.references.front().fit.bore = true;
    if (!surface_known) return take_seats(job, streams);
    for (std::size_t i = 0; i < streams.size(); ++i)
      expect_one_surface(streams[i], job.references[i].fit.surface,
                         of_stream ? RangesAs::options : RangesAs::keys);
  };
  const bool learns = !options.previous.empty() || file.verification;
  std::optional<MachineFeedback> feedback;
  const auto take_over = [&] {
    if (learns) feedback = feedback_before(file, streams, options.previous);
  };
  if (!options.previous.empty()) outputs.reads(options.previous);
  if (options.check) {
    name_job_files(outputs, file, options.folder);
    options.results.name_to(outputs);
    all_of({read, [&] { outputs.check(); }});
    take_over();
    for (std::size_t i = 0; i < streams.size(); ++i)
      expect_associable(job.references[i], streams[i]);
    return checked(outputs, job_plan_text(job, streams, surface_known));
  }
  read();
  if (!surface_known) choose_surfaces(job, streams);
  take_over();
  if (feedback) job.loop = response_of(feedback->before, feedback->prior);
  name_job_files(outputs, file, options.folder);
  options.results.name_to(outputs);
  outputs.check();
  std::optional<Waiting> waiting("fit, diagnosis and correction of " + options.stream.path);
  JobResult result = of_file(file.path, [&] { return run_job(job, std::move(streams)); });
  result.feedback = std::move(feedback);
  if (result.feedback) learn_from_cut(result, file, options.previous);
  word_unknown_axes(result);
  std::ranges::for_each(result.fits, expect_enough_readings);
  std::vector<ResultFile> files = job_files(result);
  files.insert(files.begin() + 1, {"report.html", render_report(result, file.path)});
  options.results.write(outputs, "--json", [&] { return files.front().text; });
  const EarlierRun earlier = write_job_files(outputs, result, files);
  waiting.reset();
  if (options.results.printed()) {
    if (!result.refused.empty()) std::cerr << "refused: " << result.refused << '\n';
  } else {
    print(result, outputs, files, earlier, options.verbose);
  }
  return exit_code_of_job(result);
}

}  // namespace

int run(const RunArguments& options) {
  const std::string& path = options.stream.path;
  if (!is_job(path))
    return run_lathe(job_of_stream(options.stream.file(), options.association.chosen()), options,
                     true);
  const std::string content = read_file(path);
  if (is_machine_job(content, path) && !options.previous.empty())
    throw CLI::ValidationError("--previous", "is for the cut of a lathe");
  if (is_machine_job(content, path))
    return run_machine(
        read_machine_job_toml(content, path),
        {options.folder, options.force, options.verbose, options.check, &options.results});
  return run_lathe(read_job_toml(content, path), options, false);
}

void add_run(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<RunArguments>();
  options->stream.add_to(*command, "job (TOML), probe stream or another program's recording");
  options->stream.add_range_to(*command);
  options->surface = options->association.add_to(*command);
  add_place(*command, "-o,--output", options->folder,
            "folder for the results (default INPUT_result, as shaft_result)");
  command
      ->add_option("--previous", options->previous,
                   "result.json of the part before, probed again after its cut: what stays with "
                   "the machine corrects this table")
      ->type_name("RESULT");
  add_json(*command, options->results, "trueaxis.run");
  add_usual(*command, options->force, options->check, &options->verbose);
  command->callback([=, &exit_code] {
    if (options->folder.empty()) options->folder = default_folder(options->stream.path);
    if (is_job(options->stream.path))
      expect_only(*command,
                  {"stream", "--output", "--previous", "--json", "--force", "--verbose", "--check"},
                  "is for a stream alone: write it into the job");
    else if (!options->previous.empty())
      throw CLI::ValidationError("--previous", "is for a job with a [target]");
    exit_code = run(*options);
  });
}

}  // namespace trueaxis::cli
