// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/counted.hpp"
#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/run_machine.hpp"
#include "cli/screen.hpp"
#include "cli/stream_options.hpp"
#include "cli/waiting.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "job/evidence.hpp"
#include "job/files/earlier_run.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_screen.hpp"
#include "job/files/job_toml.hpp"
#include "job/machine/files/machine_job_toml.hpp"
#include "job/one_surface.hpp"
#include "job/seat_references.hpp"
#include "report/report.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

int exit_code_of(const JobResult& result) {
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  return !fitted ? numerical : result.verdict.go() && forms_met(result) ? done : refused;
}

struct Options {
  StreamOptions stream;  ///< `path` is the job's, or a stream's
  AssociationOptions association;
  CLI::Option* surface = nullptr;
  std::string folder;
  bool force = false, verbose = false, check = false;
};

/// Whether a file is a job, as standard input is: its first line that is no comment is one of TOML.
bool is_job(const std::string& path) {
  if (path == "-" || path.ends_with(".toml")) return true;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::size_t word = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", first);
    return line[first] == '[' || (word != std::string::npos && word > first &&
                                  line.find_first_not_of(' ', word) == line.find('='));
  }
  return false;
}

/// The job of one stream that nothing else is said of.
Job job_of_stream(const Options& options) {
  const StreamReadOptions said = options.stream.said();
  JobReference reference;
  reference.stream = options.stream.path;
  reference.read = {said.diameter, said.indication, said.nominal_radius_mm, options.stream.columns,
                    options.stream.skip};
  if (std::isfinite(options.stream.range.from_mm))
    reference.read.z_from_mm = options.stream.range.from_mm;
  if (std::isfinite(options.stream.range.to_mm))
    reference.read.z_to_mm = options.stream.range.to_mm;
  reference.fit = options.association.chosen();
  Job job;
  job.path = options.stream.path;
  job.name = std::filesystem::path(options.stream.path).stem().string();
  job.references.push_back(std::move(reference));
  return job;
}

/// What is said of the files of an earlier job.
struct Earlier {
  std::string removed, kept;
};

/// Files that an earlier job wrote into the folder and this one does not: they go as they were
/// written, and are named where they were changed since. A table goes by its own rule.
Earlier take_away_earlier(Outputs& outputs, const Job& job, const std::vector<ResultFile>& files) {
  Earlier said;
  for (const WrittenFile& file : files_of_earlier_run(outputs.in_folder("result.json"), files)) {
    const std::string place = outputs.in_folder(file.name);
    const bool table =
        file.name == "table.csv" ||
        std::ranges::find(job.outputs, file.name, &ControlTable::file) != job.outputs.end();
    if (table || !std::filesystem::exists(place)) continue;
    if (outputs.remove_unchanged(place, file.hash)) {
      said.removed += "gone   " + place + ": of an earlier job\n";
    } else {
      said.kept += "warning: " + place +
                   " is of an earlier job and was changed since: it stays, and is none of this "
                   "result\n";
    }
  }
  return said;
}

/// What the job would have done, in words.
std::string would_do(const Job& job, const std::vector<ProbeStream>& streams, bool surface_known) {
  std::string text;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const std::string of = counted(streams[i].size(), "reading") + " of " + streams[i].source;
    text += i == 0 ? "" : "; ";
    text += surface_known ? std::string("fit and diagnose a ") +
                                to_string(job.references[i].fit.surface) + " in " + of
                          : "choose the surface of " + of + " by evidence, fit and diagnose it";
  }
  return text + (job.target ? "; correct the target, and decide about it" : "");
}

/// Streams of one surface each; of a stream whose surface nobody says every seat.
void take_surfaces(Job& job, std::vector<ProbeStream>& streams, bool said, bool surface_known) {
  if (!surface_known) return take_every_seat(job, streams);
  for (std::size_t i = 0; i < streams.size(); ++i)
    expect_one_surface(streams[i], job.references[i].fit.surface,
                       said ? RangesAs::keys : RangesAs::options);
}

/// All that is read and may be written.
void prepare(Outputs& outputs, const Job& job, const Options& options) {
  outputs.reads(options.stream.path);
  for (const JobReference& reference : job.references) outputs.reads(reference.stream);
  for (const ControlTable& output : job.outputs)
    if (!output.template_path.empty()) outputs.reads(output.template_path);
  outputs.into(options.folder);
  for (const ResultName& file : job_file_names(job))
    outputs.may_write_in_folder(file.name, file.schema);
  outputs.may_write_in_folder("report.html", "trueaxis.report");
}

int execute(const Options& options) {
  const std::string& path = options.stream.path;
  const bool said = is_job(path);
  Job job;
  if (said) {
    const std::string content = read_file(path);
    if (is_machine_job(content, path))
      return run_machine(read_machine_job_toml(content, path),
                         {options.folder, options.force, options.verbose, options.check});
    job = read_job_toml(content, path);
  } else {
    job = job_of_stream(options);
  }
  const bool surface_known = said || options.surface->count() > 0;
  if (!said)
    job.references.front().name =
        surface_known ? to_string(job.references.front().fit.surface) : "SURFACE";
  Outputs outputs(options.force);
  std::vector<ProbeStream> streams;
  const auto read = [&] {
    streams = said ? read_streams(job) : std::vector{options.stream.read()};
    take_surfaces(job, streams, said, surface_known);
  };
  if (options.check) prepare(outputs, job, options);
  if (options.check)
    all_of({read, [&] { outputs.check(); }});
  else
    read();
  if (options.check) return checked(outputs, would_do(job, streams, surface_known));
  if (!said) {
    for (std::size_t i = 0; i < streams.size() && !surface_known; ++i) {
      const SurfaceEvidence evidence = surface_by_evidence(streams[i]);
      job.references[i].fit.surface = evidence.surface;
      streams[i].read_as.push_back(evidence.why);
    }
    if (streams.size() == 1)
      job.references.front().name = to_string(job.references.front().fit.surface);
  }
  prepare(outputs, job, options);
  outputs.check();

  std::optional<Waiting> waiting("fit, diagnosis and correction of " + path);
  const JobResult result = run_job(std::move(job), std::move(streams));
  std::ranges::for_each(result.fits, expect_enough_readings);
  std::vector<ResultFile> files = job_files(result);
  files.insert(files.begin() + 1, {"report.html", render_report(result)});
  for (const ResultFile& file : files) outputs.write(outputs.in_folder(file.name), file.text);
  const std::string table = outputs.in_folder("table.csv");
  const bool tabled = files.back().name == "table.csv";
  if (!tabled) {  // they stand there only when they may be run
    outputs.remove_earlier(table);
    for (const ControlTable& output : result.job.outputs)
      outputs.remove_earlier(outputs.in_folder(output.file));
  }
  const Earlier earlier = take_away_earlier(outputs, result.job, files);
  outputs.commit();
  waiting.reset();
  std::cerr << earlier.kept;
  if (options.verbose) {
    std::cout << job_text(result);
  } else {
    print_screen(job_screen(result));
  }
  if (tabled) {
    std::cout << "table  " << table << '\n';
  } else if (result.correction) {
    std::cout << "table  not written: " << result.verdict.line << '\n';
  }
  for (const ResultFile& file : files)
    if (!file.note.empty())
      std::cout << "file   " << outputs.in_folder(file.name) << ": " << file.note << '\n';
  std::cout << earlier.removed << "report " << outputs.in_folder("report.html")
            << ", beside it result.json\n";
  if (!result.refused.empty()) std::cerr << "refused: " << result.refused << '\n';
  return exit_code_of(result);
}

/// What is said of a stream beside a job would be passed over in silence.
void expect_no_stream_options(const CLI::App& command) {
  constexpr std::string_view fine[] = {"--help",    "--output", "--force",
                                       "--verbose", "--check",  "stream"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || std::ranges::find(fine, name) != std::end(fine)) continue;
    throw CLI::ValidationError(name, "is of a stream alone: write it into the job");
  }
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "run",
      "the whole job: of a lathe fit, diagnosis, correction, report; of a machine "
      "of several axes diagnosis, errors, program, report");
  auto options = std::make_shared<Options>();
  options->stream.add_to(*command, "job file (TOML), or a stream or another program's recording");
  options->stream.add_range_to(*command);
  options->surface = options->association.add_to(*command);
  command
      ->add_option("-o,--output", options->folder,
                   "folder for table.csv or the new program, result.json and report.html, made if "
                   "need be")
      ->required()
      ->check(a_place());
  add_force(*command, options->force);
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([=, &exit_code] {
    if (is_job(options->stream.path)) expect_no_stream_options(*command);
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
