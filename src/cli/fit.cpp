// SPDX-License-Identifier: Apache-2.0
#include "cli/fit.hpp"

#include <iostream>
#include <memory>

#include "cli/fit_options.hpp"
#include "cli/guarded.hpp"
#include "cli/output_options.hpp"
#include "fit/files/fit_json.hpp"
#include "fit/files/fit_text.hpp"
#include "format/outputs.hpp"
#include "job/files/residuals_csv.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  StreamOptions stream;
  AssociationOptions association;
  std::string json, residuals;
  bool force = false;
};

int execute(const Options& options) {
  const ProbeStream stream = options.stream.read();
  Outputs outputs(options.force);
  outputs.reads(options.stream.path);
  outputs.may_write(options.json, "trueaxis.fit");
  outputs.may_write(options.residuals, "trueaxis.residuals");
  outputs.check();
  const FitResult result = fit(stream, options.association.chosen());
  if (result.status == FitStatus::too_few)
    throw InputError(stream.source, result.message + ": probe more");
  if (!options.json.empty()) outputs.write(options.json, fit_json(result));
  if (!options.residuals.empty()) outputs.write(options.residuals, residuals_csv(stream, result));
  outputs.commit();
  if (options.json != "-" && options.residuals != "-") std::cout << fit_text(result);
  if (result.status != FitStatus::converged) {
    std::cerr << stream.source << ": " << to_string(result.status) << ": " << result.message
              << '\n';
    return numerical;
  }
  return done;
}

}  // namespace

void add_fit(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("fit", "associate a surface with a probe stream");
  auto options = std::make_shared<Options>();
  options->stream.add_to(*command);
  options->association.add_to(*command)->required();
  command->add_option("--json", options->json, "write the result here, '-' prints it")
      ->check(a_place());
  command
      ->add_option("--residuals", options->residuals,
                   "write every reading with its residual here (CSV)")
      ->check(a_place());
  add_force(*command, options->force);
  command->callback([options, &exit_code] {
    if (!options->json.empty() && options->json == options->residuals)
      throw CLI::ValidationError("--residuals", "cannot go where --json goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
