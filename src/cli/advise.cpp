// SPDX-License-Identifier: Apache-2.0
#include "cli/advise.hpp"

#include <iostream>
#include <memory>

#include "cli/fit_options.hpp"
#include "cli/guarded.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"

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
  if (diagnosis.baseline.status == FitStatus::too_few)
    throw InputError(stream.source, diagnosis.baseline.message + ": probe more");
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
  command
      ->add_option("--false-alarm", options->false_alarm,
                   "chance of a finding in a stream that has none (0.01)")
      ->check(false_alarm_level());
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
