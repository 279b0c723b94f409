// SPDX-License-Identifier: Apache-2.0
#include "cli/diagnose.hpp"

#include <iostream>
#include <memory>

#include "cli/fit_options.hpp"
#include "cli/guarded.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/file.hpp"
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
};

/// The fit that broke, or nullptr.
const FitResult* broken_fit(const Diagnosis& diagnosis) {
  if (diagnosis.baseline.status != FitStatus::converged) return &diagnosis.baseline;
  if (diagnosis.extended.status != FitStatus::converged) return &diagnosis.extended;
  return nullptr;
}

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  DiagnoseOptions diagnose_options;
  diagnose_options.fit = options.association.chosen();
  diagnose_options.false_alarm = options.false_alarm;
  const Diagnosis diagnosis = diagnose(stream, diagnose_options);
  if (diagnosis.baseline.status == FitStatus::too_few)
    throw InputError(stream.source, diagnosis.baseline.message + ": probe more");
  const std::string json = options.json.empty() ? "" : diagnosis_json(diagnosis);
  const std::string residuals = options.residuals.empty() ? "" : residuals_csv(stream, diagnosis);
  std::vector<FileContent> files;
  if (!options.json.empty()) files.push_back({options.json, json});
  if (!options.residuals.empty()) files.push_back({options.residuals, residuals});
  write_files(files);
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
  command->add_option("--json", options->json, "write the result here, '-' prints it");
  command->add_option("--residuals", options->residuals,
                      "write every reading with what is left before and after here (CSV)");
  command->callback([options, &exit_code] {
    if (!options->json.empty() && options->json == options->residuals)
      throw CLI::ValidationError("--residuals", "cannot go where --json goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
