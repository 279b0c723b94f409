// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/fit.hpp"

#include <iostream>
#include <memory>
#include <optional>

#include "base/counted.hpp"
#include "cli/checked_fit.hpp"
#include "cli/commands.hpp"
#include "cli/fit_criterion.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "fit/files/fit_files.hpp"
#include "format/outputs.hpp"
#include "format/shell.hpp"
#include "job/files/job_results.hpp"
#include "job/files/stream_job.hpp"
#include "report/report.hpp"

namespace trueaxis::cli {
namespace {

struct FitArguments {
  StreamOptions stream;
  AssociationOptions association;
  Results results;
  FitCriterion criterion;
  bool verbose = false, check = false;
};

/// The command that was typed, as one that diagnoses.
std::string diagnose_command(const FitArguments& options) {
  std::vector<std::string> words =
      typed_command(*options.stream.command,
                    {"--json", "--residuals", "--report", "--force", "--verbose", "--check"});
  words.at(1) = "diagnose";
  return shell_line(words);
}

int execute(const FitArguments& options) {
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
                                counted(stream.size(), "reading") + " of " + stream.source);
  std::optional<Waiting> waiting("fit of " + stream.source);
  const FitOptions chosen = options.association.chosen();
  const FitResult result = checked_fit(stream, chosen);
  waiting.reset();
  expect_enough_readings(result);
  results.write(outputs, "--json", [&] { return fit_json(result); });
  results.write(outputs, "--residuals", [&] { return residuals_csv(stream, result); });
  results.write(outputs, "--report", [&] { return render_fit_report(stream, result, chosen); });
  outputs.commit();
  if (!results.printed() && options.verbose) std::cout << fit_text(result);
  if (!results.printed() && !options.verbose)
    print_screen(
        fit_screen(result) +
        (is_diagnosed(chosen.surface) && result.status != FitStatus::implausible
             ? "next   " + diagnose_command(options) + ": what the surface does not explain\n"
             : std::string()));
  return exit_code_of(result, stream.source);
}

}  // namespace

void add_fit(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("fit", "associate a surface with a probe stream");
  auto options = std::make_shared<FitArguments>();
  options->stream.add_to(*command);
  options->stream.add_range_to(*command);
  options->association.add_to(*command, true)->required();
  options->criterion.add_to(*command, options->results);
  add_stream_results(*command, options->results, "trueaxis.fit", "its residual here (CSV)");
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, command, &exit_code] {
    if (options->results.asked("--report") &&
        !is_diagnosed(surface_from_id(options->association.surface)))
      throw CLI::ValidationError("--report",
                                 "is of a cone, cylinder, plane or section: leave it "
                                 "out, --json has the numbers");
    options->criterion.expect_fitting(options->association, options->results, *command);
    exit_code =
        options->criterion.along_probe()
            ? execute(*options)
            : options->criterion.execute(options->stream, options->association, options->results);
  });
}

}  // namespace trueaxis::cli
