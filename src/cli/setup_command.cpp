// SPDX-License-Identifier: Apache-2.0
#include "cli/setup_command.hpp"

#include <iostream>
#include <memory>

#include "cli/check.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/screen.hpp"
#include "format/outputs.hpp"

namespace trueaxis::cli {
namespace {

struct SetupArguments {
  std::string path, errors, json;
  int decimals = 6;
  bool force = false, verbose = false, check = false;
};

int execute(const SetupArguments& options, const SetupCommand& which) {
  const SetupResult result = which.solve(options.path, options.decimals);
  Outputs outputs(options.force);
  for (const SetupSource& source : result.sources) outputs.reads(source.file);
  outputs.may_write(options.errors, "trueaxis.errors");
  outputs.may_write(options.json, "trueaxis.setup");
  outputs.check();
  if (options.check) return checked(outputs, "say where the part of " + options.path + " is");
  if (!result.setup.converged) {
    std::cerr << options.path << ": the six contacts do not converge: are the datum errors those "
              << "of this part?\n";
    return numerical;
  }
  if (!options.errors.empty()) outputs.write(options.errors, setup_errors_toml(result));
  if (!options.json.empty()) outputs.write(options.json, setup_json(result));
  outputs.commit();
  if (options.errors == "-" || options.json == "-") return done;
  if (options.verbose)
    std::cout << setup_text(result);
  else
    print_screen(setup_screen(result));
  if (!options.errors.empty()) std::cout << "errors " << options.errors << '\n';
  if (!options.json.empty()) std::cout << "result " << options.json << '\n';
  return done;
}

}  // namespace

void add_setup_command(CLI::App& app, const SetupCommand& which, int& exit_code) {
  CLI::App* command = app.add_subcommand(which.name, which.description);
  auto options = std::make_shared<SetupArguments>();
  command->add_option("file", options->path, which.file)->required();
  command
      ->add_option("-o,--output", options->errors,
                   "write it as errors of the workpiece, X0W … C0W, here (TOML), '-' prints them")
      ->check(a_place());
  command->add_option("--json", options->json, "write the result here (JSON), '-' prints it")
      ->check(a_place());
  command
      ->add_option("--decimals", options->decimals,
                   "of mm and degrees in the frames of the controls (6)")
      ->check(CLI::Range(least_frame_decimals, most_frame_decimals));
  add_force(*command, options->force);
  add_verbose(*command, options->verbose);
  add_check(*command, options->check);
  command->callback([options, which, &exit_code] { exit_code = execute(*options, which); });
}

}  // namespace trueaxis::cli
