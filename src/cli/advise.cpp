// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/stream_options.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
};

int advise(const ProbeStream& stream, const FitOptions& fit, double false_alarm) {
  DiagnoseOptions options;
  options.fit = fit;
  options.false_alarm = false_alarm;
  const Diagnosis diagnosis = diagnose(stream, options);
  expect_enough_readings(diagnosis.baseline);
  std::cout << advice_text(diagnosis);
  return diagnosis.baseline.status == FitStatus::converged ? done : numerical;
}

int advise_job(const Options& options) {
  const Job job = read_job_toml(options.stream.path);
  const std::vector<ProbeStream> streams = read_streams(job);
  int worst = done;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const JobReference& reference = job.references[i];
    std::cout << (i ? "\n" : "") << reference.name << " (" << reference.stream << ")\n";
    worst = std::max(worst, advise(streams[i], reference.fit, options.false_alarm));
  }
  return worst;
}

}  // namespace

void add_advise(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("advise", "the next measurement, and what every other one would tell");
  auto options = std::make_shared<Options>();
  options->stream.add_to(*command, "probe stream (CSV), '-' for standard input, or a job (.toml)");
  const CLI::Option* surface = options->association.add_to(*command);
  add_false_alarm(*command, options->false_alarm);
  command->callback([options, surface, &exit_code] {
    if (options->stream.path.ends_with(".toml")) {
      exit_code = advise_job(*options);
      return;
    }
    if (surface->count() == 0) throw CLI::RequiredError("--surface");
    exit_code = advise(options->stream.read(), options->association.chosen(), options->false_alarm);
  });
}

}  // namespace trueaxis::cli
