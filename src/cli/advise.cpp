// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "base/diagnostics.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_diagnosed.hpp"
#include "cli/options.hpp"
#include "cli/probing_program.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "format/text_layout.hpp"
#include "job/agreement.hpp"
#include "job/conclude.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "job/files/stream_job.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "study/planning/probing_plan.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {
namespace {

struct AdviseArguments {
  std::vector<std::string> data;  ///< a stream or a job; with --machine measurements, or none
  MachineDiagnosed machine;
  StreamOptions stream;
  AssociationOptions association;
  ProbingOption program;
  Results results;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  bool verbose = false, check = false;
};

Diagnosis advise(const ProbeStream& stream, const FitOptions& fit, double false_alarm,
                 bool printed = false) {
  DiagnoseOptions options;
  options.fit = fit;
  options.false_alarm = false_alarm;
  std::optional<Waiting> waiting("diagnosis of " + stream.source);
  Diagnosis diagnosis = diagnose(corrected_by_known(stream, fit), options);
  waiting.reset();
  expect_enough_readings(diagnosis.baseline);
  if (!printed) std::cout << advice_text(diagnosis);
  return diagnosis;
}

int exit_code_of_advice(const Diagnosis& diagnosis) {
  return diagnosis.baseline.status == FitStatus::converged ? done : numerical;
}

/// What the tolerance of the job asks of the measurement: its verdict, as `run` would have it.
JobResult judged(IdentifiedJob job, const std::string& file) {
  job.agreement = hold_together(job);
  return of_file(file, [&] { return conclude(std::move(job)); });
}

/// The diagnosis of every reference, and the verdict on a tolerance.
Json advice_object(const std::string& job, const JobResult& result, bool with_verdict) {
  const auto reference = [&](std::size_t i) -> Json {
    return {{"name", result.job.references[i].name},
            {"diagnosis", diagnosis_object(*result.diagnoses[i])}};
  };
  Json json{{"schema", "trueaxis.advice/1"},
            {"version", TRUEAXIS_VERSION},
            {"job", job},
            {"references", list_of_first(result.diagnoses.size(), reference)},
            {"verdict", nullptr}};
  if (with_verdict)
    json["verdict"] = {{"decision", to_string(result.verdict.decision)},
                       {"line", verdict_line(result)}};
  return json;
}

int advise_machine(const AdviseArguments& options, const std::string& content, Outputs& outputs) {
  const MachineJob job = read_machine_job_toml(content, options.stream.path);
  for (const JobInput& input : job.inputs) outputs.reads(input.file);
  outputs.check();
  if (options.check)
    return checked(outputs, "diagnose the machine and propose the next measurement of it");
  return advise_machine_job(job, options.results, outputs, options.verbose);
}

/// Writes the next measurement of every reference as one program; what the screen says of it.
std::string write_job_program(const AdviseArguments& options, const IdentifiedJob& job,
                              Outputs& outputs) {
  if (!options.program.asked()) return "";
  std::vector<std::pair<std::string, std::vector<nc::ProbingPlan>>> references;
  for (std::size_t i = 0; i < job.diagnoses.size(); ++i)
    references.emplace_back(job.job.references[i].name, study::probing_plans(*job.diagnoses[i]));
  const std::string& place = options.results["--output"];
  std::string what;
  const nc::ProbingProgram program = options.program.write_each(references, place, what);
  outputs.write(place, program.text);
  return "\nProgram\n  " + ProbingOption::line(program, place) + what;
}

int advise_job(const CLI::App& command, AdviseArguments& options) {
  constexpr const char* in_job = "is for a stream alone: write it into the job";
  expect_only(command,
              {"stream", "--false-alarm", "--json", "--force", "--verbose", "--check", "--control",
               "--limits", "--air-run", "--output"},
              in_job);
  const std::string content = read_file(options.stream.path);
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.stream.path);
  const bool machine = is_machine_job(content, options.stream.path);
  if (machine) {
    expect_none(command, {"--false-alarm"}, in_job);
    expect_none(command, {"--control", "--limits", "--air-run", "--output"},
                "is for a lathe: a machine of several axes has --machine and --program");
  } else {
    options.results.say("--json", "trueaxis.advice");
    options.results.say("--output", "trueaxis.probing_program");
    options.program.read(options.results, outputs);
  }
  results.name_to(outputs);
  if (machine) return advise_machine(options, content, outputs);
  JobFile file = read_job_toml(content, options.stream.path);
  IdentifiedJob result;
  result.streams = read_streams(file);
  result.job = std::move(file.job);
  for (std::size_t i = 0; i < result.streams.size(); ++i)
    expect_one_surface(result.streams[i], result.job.references[i].fit.surface, RangesAs::keys);
  for (const StreamFile& stream : file.streams) outputs.reads(stream.path);
  outputs.check();
  if (options.check)
    return checked(outputs, "diagnose every reference and propose the next measurement of it");
  int worst = done;
  const bool printed = results.printed();
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    const JobReference& reference = result.job.references[i];
    if (!printed)
      std::cout << (i ? "\n" : "") << reference.name << " (" << result.streams[i].source << ")\n";
    const Diagnosis& diagnosis =
        result.diagnoses
            .emplace_back(advise(result.streams[i], reference.fit, options.false_alarm, printed))
            .value();
    result.fits.push_back(diagnosis.baseline);
    result.resimulations.emplace_back();
    worst = std::max(worst, exit_code_of_advice(diagnosis));
  }
  const bool judge = worst == done && result.job.coaxiality_tolerance_mm;
  JobResult found;
  if (judge)
    found = judged(std::move(result), file.path);
  else
    static_cast<IdentifiedJob&>(found) = std::move(result);
  if (judge && !printed)
    std::cout << "\nTolerance of the job\n" << layout::wrapped("  ", verdict_line(found));
  results.write(outputs, "--json",
                [&] { return json_text(advice_object(options.stream.path, found, judge)); });
  const std::string program = write_job_program(options, found, outputs);
  outputs.commit();
  if (!printed) std::cout << program;
  if (!printed) std::cout << results.line("result ", "--json");
  return worst;
}

/// Writes the next measurement as a program; what the screen says of it.
std::string write_program(const AdviseArguments& options, const Diagnosis& diagnosis,
                          Outputs& outputs) {
  if (!options.program.asked()) return "";
  const std::string& place = options.results["--output"];
  const nc::ProbingProgram program =
      options.program.write_first(study::probing_plans(diagnosis), place);
  outputs.write(place, program.text);
  return "\nProgram\n  " + ProbingOption::line(program, place);
}

/// Options for the one would have no effect on the other.
bool is_of_machine(const CLI::App& command, const AdviseArguments& options) {
  const bool machine = !options.machine.machine.machine.empty();
  if (!machine && options.data.empty()) throw CLI::RequiredError("stream");
  if (machine) {
    expect_only(command,
                {"stream", "--machine", "--errors", "--sign", "--large-errors", "--program",
                 "--json", "--output", "--force", "--false-alarm", "--coverage-factor", "--check",
                 "--verbose", "--noise-um"},
                "is for a stream: --machine has none");
    if (!options.data.empty())
      expect_none(command, {"--noise-um"}, "is for a first plan: a measurement states its own");
  } else {
    expect_one_stream(command, options.data.size());
  }
  return machine;
}

}  // namespace

void add_advise(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<AdviseArguments>();
  command->add_option("stream", options->data,
                      "probe stream (CSV) or job (.toml); with --machine its measurements");
  options->stream.add_meaning_to(*command);
  options->stream.add_range_to(*command);
  options->machine.add_to(*command);
  options->program.add_to(*command);
  options->results.add(*command, "-o,--output", "trueaxis.measurement_plan",
                       "probing program; with --machine the next positions (CSV), to fill in");
  options->results.add(*command, "--json", "trueaxis.machine_diagnosis",
                       "diagnosis, for a job of every reference (JSON); - prints it");
  add_force(*command, options->results.force);
  const CLI::Option* surface = options->association.add_to(*command);
  add_false_alarm(*command, options->false_alarm);
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, command, surface, &exit_code] {
    if (is_of_machine(*command, *options)) {
      options->machine.data = options->data;
      options->machine.false_alarm = options->false_alarm;
      options->machine.coverage_factor = options->association.fit.coverage_factor;
      options->machine.verbose = options->verbose;
      options->machine.check = options->check;
      options->machine.noise_um = options->association.noise_um;
      options->results.is_filled_in("--output");
      exit_code = options->machine.advise(options->results);
      return;
    }
    options->stream.path = options->data.front();
    if (options->stream.path.ends_with(".toml")) {
      exit_code = advise_job(*command, *options);
      return;
    }
    if (surface->count() == 0) throw CLI::RequiredError("--surface");
    options->results.say("--json", "trueaxis.diagnosis");
    options->results.say("--output", "trueaxis.probing_program");
    Outputs outputs(options->results.force);
    outputs.reads(options->stream.path);
    options->program.read(options->results, outputs);
    options->results.name_to(outputs);
    outputs.check();
    const ProbeStream stream = options->stream.read();
    expect_one_surface(stream, options->association.chosen().surface, RangesAs::options);
    if (options->check) {
      exit_code = checked(outputs, "diagnose a " + options->association.surface + " in " +
                                       std::to_string(stream.size()) +
                                       " readings and propose the next measurement");
      return;
    }
    const Diagnosis diagnosis = advise(stream, options->association.chosen(stream),
                                       options->false_alarm, options->results.printed());
    options->results.write(outputs, "--json", [&] { return diagnosis_json(diagnosis); });
    const std::string program = write_program(*options, diagnosis, outputs);
    outputs.commit();
    if (!options->results.printed()) std::cout << program;
    exit_code = exit_code_of_advice(diagnosis);
  });
}

}  // namespace trueaxis::cli
