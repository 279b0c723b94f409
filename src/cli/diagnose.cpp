// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>

#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "cli/commands.hpp"
#include "cli/expect_no_mistake.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "cli/options.hpp"
#include "cli/screen.hpp"
#include "cli/stream_options.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "job/files/job_results.hpp"
#include "machine/files/errors_toml.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  std::vector<std::string> data;  ///< a stream, or the measurements of a machine
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  ResultOptions result;
  MachineOptions machine;
  std::string errors_output;
  bool verbose = false;
};

/// The fit that broke, or nullptr.
const FitResult* broken_fit(const Diagnosis& diagnosis) {
  if (diagnosis.baseline.status != FitStatus::converged) return &diagnosis.baseline;
  if (diagnosis.extended.status != FitStatus::converged) return &diagnosis.extended;
  return nullptr;
}

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  const auto& [json, residuals, force] = options.result;
  Outputs outputs(force);
  outputs.reads(options.stream.path);
  outputs.may_write(json, "trueaxis.diagnosis");
  outputs.may_write(residuals, "trueaxis.residuals");
  outputs.check();
  DiagnoseOptions diagnose_options;
  diagnose_options.fit = options.association.chosen();
  diagnose_options.false_alarm = options.false_alarm;
  const Diagnosis diagnosis = diagnose(stream, diagnose_options);
  expect_enough_readings(diagnosis.baseline);
  if (!json.empty()) outputs.write(json, diagnosis_json(diagnosis));
  if (!residuals.empty()) outputs.write(residuals, residuals_csv(stream, diagnosis));
  outputs.commit();
  if (!options.result.printed() && options.verbose) std::cout << diagnosis_text(diagnosis);
  if (!options.result.printed() && !options.verbose) print_screen(diagnosis_screen(diagnosis));
  if (const FitResult* fit = broken_fit(diagnosis)) {
    std::cerr << stream.source << ": " << to_string(fit->status) << ": " << fit->message << '\n';
    return numerical;
  }
  return done;
}

/// Options of a stream beside --machine would be passed over in silence.
void expect_of_machine(const CLI::App& command) {
  constexpr const char* fine[] = {"stream",   "--machine",     "--errors", "--sign", "--json",
                                  "--output", "--false-alarm", "--force",  "--help"};
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && std::ranges::find(fine, option->get_name()) == std::end(fine))
      throw CLI::ValidationError(option->get_name(), "is of a stream: --machine has none");
}

int execute_machine(const Options& options) {
  const MachineFile file = options.machine.read_machine();
  MachineDiagnoseOptions diagnose_options;
  diagnose_options.calibration.errors = options.machine.read_errors_of(file);
  diagnose_options.false_alarm = options.false_alarm;
  const auto data = read_measurements(options.data, file.machine);
  const std::string& json = options.result.json;
  Outputs outputs(options.result.force);
  outputs.reads(options.machine.machine);
  for (const std::string& path : options.data) outputs.reads(path);
  for (const std::string& path : options.machine.errors) outputs.reads(path);
  outputs.may_write(json, "trueaxis.machine_diagnosis");
  outputs.may_write(options.errors_output, "trueaxis.errors");
  outputs.check();
  const MachineDiagnosis found = diagnose_machine(file.machine, data, diagnose_options);
  expect_no_mistake(file.machine, data, diagnose_options.calibration, found.baseline);
  if (!found.baseline.converged) {
    std::cerr << options.data.front() << ": not converged: " << found.baseline.message << '\n';
    return numerical;
  }
  if (const std::string why = implausible(found.baseline, diagnose_options.calibration);
      !why.empty())
    throw Refusal(why);
  if (!json.empty()) outputs.write(json, machine_diagnosis_json(found, file.machine));
  outputs.write(options.errors_output, errors_toml(found.errors, &file.machine));
  outputs.commit();
  if (json != "-" && options.errors_output != "-") std::cout << machine_diagnosis_text(found);
  return done;
}

/// A machine's measurements, or one stream of a surface.
int execute_either(const CLI::App& command, Options& options, bool surface_said) {
  if (!options.machine.machine.empty()) {
    expect_of_machine(command);
    if (!options.errors_output.empty() && options.errors_output == options.result.json)
      throw CLI::ValidationError("-o", "cannot go where --json goes");
    return execute_machine(options);
  }
  if (options.data.size() > 1)
    throw CLI::ValidationError("stream", "one stream, or several measurements with --machine");
  if (!surface_said) throw CLI::RequiredError("--surface");
  if (!options.errors_output.empty())
    throw CLI::ValidationError("-o", "writes the errors of a machine: name it with --machine");
  if (!options.machine.errors.empty() || !options.machine.sign.empty())
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
  auto options = std::make_shared<Options>();
  command
      ->add_option("stream", options->data,
                   "probe stream (CSV), '-' for standard input; with --machine the measurements "
                   "(CSV) of kinds ball, bar, array, axis, which together are one")
      ->required();
  options->stream.add_meaning_to(*command);
  const CLI::Option* const surface = options->association.add_to(*command);
  command->add_option("--machine", options->machine.machine,
                      "the machine (TOML) that was measured; no --surface then");
  options->machine.add_errors_to(*command);
  command
      ->add_option("-o,--output", options->errors_output,
                   "with --machine: write its errors here (TOML): given, always fitted and found")
      ->check(a_place());
  add_false_alarm(*command, options->false_alarm);
  options->result.add_to(*command, "what is left before and after here (CSV)");
  add_verbose(*command, options->verbose);
  command->callback([options, command, surface, &exit_code] {
    exit_code = execute_either(*command, *options, surface->count() > 0);
  });
}

}  // namespace trueaxis::cli
