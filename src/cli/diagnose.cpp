// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "base/counted.hpp"
#include "cli/checked_fit.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "job/files/job_results.hpp"
#include "job/files/stream_job.hpp"
#include "report/report.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::cli {
namespace {

struct DiagnoseArguments {
  StreamOptions stream;
  AssociationOptions association;
  double false_alarm = DiagnoseOptions{}.false_alarm;
  Results results;
  bool verbose = false, check = false;
};

int execute(const DiagnoseArguments& options) {
  const Results& results = options.results;
  Outputs outputs(results.force);
  ProbeStream stream = read_one_surface(options.stream, options.association, results, outputs);
  if (options.check)
    return checked(outputs, "fit a " + options.association.surface + " to " +
                                counted(stream.size(), "reading") + " of " + stream.source +
                                " and diagnose it");
  std::optional<Waiting> waiting("diagnosis of " + stream.source);
  DiagnoseOptions diagnose_options;
  diagnose_options.fit = options.association.chosen(stream);
  diagnose_options.false_alarm = options.false_alarm;
  const CheckedDiagnosis found = checked_diagnosis(std::move(stream), diagnose_options);
  const Diagnosis& diagnosis = found.diagnosis;
  waiting.reset();
  expect_enough_readings(diagnosis.baseline);
  results.write(outputs, "--json", [&] { return diagnosis_with_form(diagnosis, found.form); });
  results.write(outputs, "--residuals", [&] { return residuals_csv(found.stream, diagnosis); });
  results.write(outputs, "--report", [&] {
    return render_diagnosis_report(found.stream, diagnosis, diagnose_options.fit, found.form);
  });
  outputs.commit();
  if (!results.printed() && options.verbose)
    std::cout << diagnosis_text(diagnosis) << part_form_text(found.form);
  const FitResult& deciding = found.deciding_fit();
  if (!results.printed() && !options.verbose)
    print_screen(diagnosis_screen(diagnosis, deciding.status == FitStatus::converged
                                                 ? part_form_screen(found.form, "")
                                                 : ""));
  return exit_code_of(deciding, found.stream.source);
}

}  // namespace

void add_diagnose(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<DiagnoseArguments>();
  options->stream.add_to(*command);
  options->stream.add_range_to(*command);
  options->association.add_to(*command)->required();
  add_false_alarm(*command, options->false_alarm);
  add_stream_results(*command, options->results, "trueaxis.diagnosis",
                     "its residual before and after");
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
