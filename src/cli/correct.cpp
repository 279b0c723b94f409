// SPDX-License-Identifier: Apache-2.0
#include "cli/correct.hpp"

#include <iostream>
#include <memory>

#include "cli/earlier_table.hpp"
#include "cli/guarded.hpp"
#include "correct/files/table_csv.hpp"
#include "correct/files/table_text.hpp"
#include "fit/files/fit_json.hpp"
#include "format/file.hpp"
#include "job/files/job_toml.hpp"
#include "trueaxis/error.hpp"

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
  const bool follows = correction.margin.follows;
  if (follows && !options.preview) write_file(options.table, correction_csv(correction));
  if (options.preview || options.table != "-") std::cout << correction_preview(correction);
  if (!follows) {
    if (!options.preview) remove_earlier_table(options.table);
    throw Refusal("the actuator cannot follow: " + correction.margin.breaks + "; " +
                  correction.margin.remedy);
  }
  return done;
}

}  // namespace

void add_correct(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("correct", "the fast-tool-servo table of a fit");
  auto options = std::make_shared<Options>();
  command->add_option("fit", options->fit, "result of 'fit --json'")->required();
  command
      ->add_option("--target", options->target,
                   "TOML with [target], [cut] and [actuator], as in a job")
      ->required();
  auto* table =
      command->add_option("-o,--output", options->table, "the table (CSV), '-' prints it");
  auto* preview = command->add_flag("--preview", options->preview,
                                    "print extremes and harmonics, write nothing");
  preview->excludes(table);
  command->callback([options, &exit_code] {
    if (!options->preview && options->table.empty())
      throw CLI::RequiredError("-o TABLE or --preview");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
