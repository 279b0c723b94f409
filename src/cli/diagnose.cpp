// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "base/counted.hpp"
#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_diagnosed.hpp"
#include "cli/options.hpp"
#include "cli/screen.hpp"
#include "cli/stream_options.hpp"
#include "cli/waiting.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "format/reason_words.hpp"
#include "job/doubts.hpp"
#include "job/files/job_results.hpp"
#include "job/files/part_form_files.hpp"
#include "job/files/stream_job.hpp"
#include "report/stream_report.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::cli {
namespace {

struct DiagnoseArguments {
  std::vector<std::string> data;  ///< a stream, or the measurements of a machine
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  ResultOptions result;
  MachineDiagnosed machine;
  bool verbose = false, check = false;
};

/// The fit that broke, or nullptr.
const FitResult* broken_fit(const Diagnosis& diagnosis) {
  if (diagnosis.baseline.status != FitStatus::converged) return &diagnosis.baseline;
  if (diagnosis.extended.status != FitStatus::converged) return &diagnosis.extended;
  return nullptr;
}

int execute(const DiagnoseArguments& options) {
  const auto& [json, residuals, report, force] = options.result;
  Outputs outputs(force);
  outputs.reads(options.stream.path);
  outputs.may_write(json, "trueaxis.diagnosis");
  outputs.may_write(residuals, "trueaxis.residuals");
  outputs.may_write(report, "trueaxis.report");
  ProbeStream stream;
  all_of({[&] {
            stream = options.stream.read();
            expect_one_surface(stream, options.association.chosen().surface, RangesAs::options);
          },
          [&] { outputs.check(); }});
  if (options.check)
    return checked(outputs, "fit a " + options.association.surface + " to " +
                                counted(stream.size(), "reading") + " of " + stream.source +
                                " and diagnose it");
  std::optional<Waiting> waiting("diagnosis of " + stream.source);
  DiagnoseOptions diagnose_options;
  diagnose_options.fit = options.association.chosen();
  diagnose_options.false_alarm = options.false_alarm;
  Diagnosis diagnosis = diagnose(stream, diagnose_options);
  if (const auto why = why_axis_unknown(stream, diagnosis))
    withhold_axis(diagnosis, words_of(*why));
  const PartForm form = part_form({stream, &diagnosis}, diagnose_options.fit, {});
  waiting.reset();
  expect_enough_readings(diagnosis.baseline);
  if (!json.empty()) outputs.write(json, diagnosis_with_form(diagnosis, form));
  if (!residuals.empty()) outputs.write(residuals, residuals_csv(stream, diagnosis));
  if (!report.empty())
    outputs.write(report, render_diagnosis_report(stream, diagnosis, diagnose_options.fit, form));
  outputs.commit();
  if (!options.result.printed() && options.verbose)
    std::cout << diagnosis_text(diagnosis) << part_form_text(form);
  if (!options.result.printed() && !options.verbose)
    print_screen(
        diagnosis_screen(diagnosis, broken_fit(diagnosis) ? "" : part_form_screen(form, "")));
  const FitResult* broken = broken_fit(diagnosis);
  return exit_code_of(broken ? *broken : diagnosis.extended, stream.source);
}

/// Options of a stream beside --machine would be passed over in silence.
void expect_of_machine(const CLI::App& command) {
  constexpr const char* fine[] = {"stream",   "--machine", "--errors",      "--sign",   "--json",
                                  "--output", "--program", "--false-alarm", "--report", "--force",
                                  "--help",   "--verbose", "--check"};
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && std::ranges::find(fine, option->get_name()) == std::end(fine))
      throw CLI::ValidationError(option->get_name(), "is of a stream: --machine has none");
}

/// A machine's measurements, or one stream of a surface.
int execute_either(const CLI::App& command, DiagnoseArguments& options, bool surface_said) {
  MachineDiagnosed& run = options.machine;
  if (!run.machine.machine.empty()) {
    expect_of_machine(command);
    if (!run.errors_output.empty() && run.errors_output == options.result.json)
      throw CLI::ValidationError("-o", "cannot go where --json goes");
    run.report = options.result.report;
    if (!run.report.empty() &&
        (run.report == run.errors_output || run.report == options.result.json))
      throw CLI::ValidationError("--report", "cannot go where -o or --json goes");
    run.data = options.data;
    run.json = options.result.json;
    run.false_alarm = options.false_alarm;
    run.force = options.result.force;
    run.verbose = options.verbose;
    run.check = options.check;
    return run.diagnose();
  }
  if (options.data.size() > 1)
    throw CLI::ValidationError("stream", "one stream, or several measurements with --machine");
  if (!surface_said) throw CLI::RequiredError("--surface");
  if (!run.program.empty())
    throw CLI::ValidationError("--program", "is of a machine: name it with --machine");
  if (!run.errors_output.empty())
    throw CLI::ValidationError("-o", "writes the errors of a machine: name it with --machine");
  if (!run.machine.errors.empty() || !run.machine.sign.empty() || run.machine.large_errors)
    throw CLI::ValidationError("--errors", "is of a machine: name it with --machine");
  options.stream.path = options.data.front();
  options.result.expect_apart();
  return execute(options);
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "diagnose",
      "find and name what the ideal surface misses in a stream, or the model of a "
      "machine in measurements on it");
  auto options = std::make_shared<DiagnoseArguments>();
  command
      ->add_option("stream", options->data,
                   "probe stream (CSV), '-' for standard input; with --machine the measurements "
                   "(CSV) of kinds ball, bar, array, axis, which together are one")
      ->required();
  options->stream.add_meaning_to(*command);
  options->stream.add_range_to(*command);
  const CLI::Option* const surface = options->association.add_to(*command);
  options->machine.add_to(*command);
  command
      ->add_option("-o,--output", options->machine.errors_output,
                   "with --machine: write its errors here (TOML), those given and those found")
      ->check(a_place());
  add_false_alarm(*command, options->false_alarm);
  options->result.add_to(*command, "what is left before and after here (CSV)");
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, command, surface, &exit_code] {
    exit_code = execute_either(*command, *options, surface->count() > 0);
  });
}

}  // namespace trueaxis::cli
