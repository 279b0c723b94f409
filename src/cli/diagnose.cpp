// SPDX-License-Identifier: Apache-2.0
#include "cli/diagnose.hpp"

#include <iostream>
#include <memory>

#include "cli/fit_options.hpp"
#include "cli/guarded.hpp"
#include "cli/output_options.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "job/files/residuals_csv.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  std::string json, residuals;
  bool force = false;
};

/// The fit that broke, or nullptr.
const FitResult* broken_fit(const Diagnosis& diagnosis) {
  if (diagnosis.baseline.status != FitStatus::converged) return &diagnosis.baseline;
  if (diagnosis.extended.status != FitStatus::converged) return &diagnosis.extended;
  return nullptr;
}

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  Outputs outputs(options.force);
  outputs.reads(options.stream.path);
  outputs.may_write(options.json, "trueaxis.diagnosis");
  outputs.may_write(options.residuals, "trueaxis.residuals");
  outputs.check();
  DiagnoseOptions diagnose_options;
  diagnose_options.fit = options.association.chosen();
  diagnose_options.false_alarm = options.false_alarm;
  const Diagnosis diagnosis = diagnose(stream, diagnose_options);
  if (diagnosis.baseline.status == FitStatus::too_few)
    throw InputError(stream.source, diagnosis.baseline.message + ": probe more");
  if (!options.json.empty()) outputs.write(options.json, diagnosis_json(diagnosis));
  if (!options.residuals.empty())
    outputs.write(options.residuals, residuals_csv(stream, diagnosis));
  outputs.commit();
  if (options.json != "-" && options.residuals != "-") std::cout << diagnosis_text(diagnosis);
  if (const FitResult* fit = broken_fit(diagnosis)) {
    std::cerr << stream.source << ": " << to_string(fit->status) << ": " << fit->message << '\n';
    return numerical;
  }
  return done;
}

}  // namespace

void add_diagnose(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("diagnose", "find and name what the ideal surface misses in a stream");
  auto options = std::make_shared<Options>();
  options->stream.add_to(*command);
  options->association.add_to(*command)->required();
  command
      ->add_option("--false-alarm", options->false_alarm,
                   "chance of a finding in a stream that has none (0.01)")
      ->check(false_alarm_level());
  command->add_option("--json", options->json, "write the result here, '-' prints it")
      ->check(a_place());
  command
      ->add_option("--residuals", options->residuals,
                   "write every reading with what is left before and after here (CSV)")
      ->check(a_place());
  add_force(*command, options->force);
  command->callback([options, &exit_code] {
    if (!options->json.empty() && options->json == options->residuals)
      throw CLI::ValidationError("--residuals", "cannot go where --json goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
