// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/stream_options.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "job/files/job_results.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  ResultOptions result;
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
  if (!options.result.printed()) std::cout << diagnosis_text(diagnosis);
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
  add_false_alarm(*command, options->false_alarm);
  options->result.add_to(*command, "what is left before and after here (CSV)");
  command->callback([options, &exit_code] {
    options->result.expect_apart();
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
