// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "trueaxis/base/error.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/fit_json.hpp"
#include "trueaxis/io/job_toml.hpp"
#include "trueaxis/io/table_csv.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  std::string fit, target, table;
  bool preview = false;
};

int execute(const Options& options) {
  const FitResult fit = read_fit_json(options.fit);
  const Job job = read_target_toml(options.target);
  const Correction correction = make_correction(fit.axis, *job.target, job.tool, job.actuator);
  if (options.preview || options.table != "-") std::cout << correction_preview(correction);
  if (!correction.margin.follows) {
    throw Refusal("the actuator cannot follow: " + correction.margin.breaks + "; it would at " +
                  std::to_string(static_cast<int>(correction.margin.max_speed_rpm)) + " rpm or less");
  }
  if (!options.preview) write_file(options.table, correction_csv(correction));
  return done;
}

}  // namespace

void add_correct(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("correct", "the fast-tool-servo table of a fit");
  auto options = std::make_shared<Options>();
  command->add_option("fit", options->fit, "result of 'fit --json'")->required();
  command->add_option("--target", options->target, "TOML with [target], [cut] and [actuator], as in a job")->required();
  auto* table = command->add_option("-o,--output", options->table, "the table (CSV), '-' prints it");
  auto* preview = command->add_flag("--preview", options->preview, "print extremes and harmonics, write nothing");
  preview->excludes(table);
  command->callback([options, &exit_code] {
    if (!options->preview && options->table.empty()) throw CLI::RequiredError("-o TABLE or --preview");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
