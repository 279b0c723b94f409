// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "base/counted.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/outputs.hpp"
#include "format/reason_words.hpp"
#include "job/doubts.hpp"
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

/// The fit that broke, or nullptr.
const FitResult* broken_fit(const Diagnosis& diagnosis) {
  if (diagnosis.baseline.status != FitStatus::converged) return &diagnosis.baseline;
  if (diagnosis.extended.status != FitStatus::converged) return &diagnosis.extended;
  return nullptr;
}

int execute(const DiagnoseArguments& options) {
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.stream.path);
  results.name_to(outputs);
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
  stream = corrected_by_known(std::move(stream), diagnose_options.fit);
  Diagnosis diagnosis = diagnose(stream, diagnose_options);
  if (const auto why = why_axis_unknown(stream, diagnosis))
    withhold_axis(diagnosis, words_of(*why));
  const PartForm form = part_form({stream, &diagnosis}, diagnose_options.fit, {});
  waiting.reset();
  expect_enough_readings(diagnosis.baseline);
  results.write(outputs, "--json", [&] { return diagnosis_with_form(diagnosis, form); });
  results.write(outputs, "--residuals", [&] { return residuals_csv(stream, diagnosis); });
  results.write(outputs, "--report", [&] {
    return render_diagnosis_report(stream, diagnosis, diagnose_options.fit, form);
  });
  outputs.commit();
  if (!results.printed() && options.verbose)
    std::cout << diagnosis_text(diagnosis) << part_form_text(form);
  if (!results.printed() && !options.verbose)
    print_screen(
        diagnosis_screen(diagnosis, broken_fit(diagnosis) ? "" : part_form_screen(form, "")));
  const FitResult* broken = broken_fit(diagnosis);
  return exit_code_of(broken ? *broken : diagnosis.extended, stream.source);
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
