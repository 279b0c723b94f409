// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/fit.hpp"

#include <iostream>
#include <memory>
#include <optional>

#include "base/counted.hpp"
#include "cli/checked_fit.hpp"
#include "cli/commands.hpp"
#include "cli/fit_points.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "cli/terminal.hpp"
#include "fit/files/fit_files.hpp"
#include "fit/plausible.hpp"
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
  FitPoints points;
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
  ProbeStream stream = read_one_surface(options.stream, options.association, results, outputs);
  if (options.check)
    return checked(outputs, "fit a " + options.association.surface + " to " +
                                counted(stream.size(), "reading") + " of " + stream.source);
  std::optional<Waiting> waiting("fit of " + stream.source);
  const FitOptions chosen = options.association.chosen(stream);
  FitResult result = checked_fit(stream, chosen);
  withhold_if_drawn(stream, result);
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

int fit_points(FitArguments& options, const CLI::App& command) {
  if (command.count("--criterion") == 0) options.criterion.name = "gaussian";
  if (options.criterion.along_probe())
    throw CLI::ValidationError("--criterion", "probe is for a stream: points have no probe line");
  options.points.expect_fitting(command, options.criterion.name);
  if (options.points.path.empty()) options.points.path = options.stream.path;
  if (options.points.path.empty()) throw CLI::RequiredError("--points");
  options.results.say("--json", "trueaxis.association");
  options.results.say("--residuals", "trueaxis.distances");
  if (options.results["--x3p"] == "-")
    throw CLI::ValidationError("--x3p", "is a binary file: give it a name");
  return options.points.execute(options.criterion.name, options.results, options.check);
}

int fit_stream(FitArguments& options, const CLI::App& command) {
  if (options.stream.path.empty()) throw CLI::RequiredError("stream");
  if (command.count("--surface") == 0) throw CLI::RequiredError("--surface");
  expect_none(command, {"--material", "--unit", "--array", "--qif", "--x3p", "--threads"},
              "is for points: name them with --points");
  if (options.results.asked("--report") &&
      !is_diagnosed(surface_from_id(options.association.surface)))
    throw CLI::ValidationError("--report",
                               "is for a cone, cylinder, plane or section: leave it out, --json "
                               "has the numbers");
  options.criterion.expect_fitting(options.association, options.results, command);
  return options.criterion.along_probe()
             ? execute(options)
             : options.criterion.execute(options.stream, options.association, options.results);
}

}  // namespace

void add_fit(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<FitArguments>();
  command->add_option("stream", options->stream.path, "probe stream (CSV); - for standard input");
  options->stream.add_meaning_to(*command);
  options->stream.add_range_to(*command);
  options->association.add_to(*command, true);
  options->criterion.add_to(*command, options->results);
  add_stream_results(*command, options->results, "trueaxis.fit", "its residual");
  options->points.add_to(*command, options->results);
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, command, &exit_code] {
    exit_code =
        options->points.asked() ? fit_points(*options, *command) : fit_stream(*options, *command);
  });
}

}  // namespace trueaxis::cli
