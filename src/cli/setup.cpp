// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "fixture/files/setup_output.hpp"
#include "format/outputs.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

/// What `setup locators` and `setup datums` have in common: one file in, a set-up out.
struct SetupCommand {
  const char* file;
  /// Reads the file and finds the set-up, its frames with so many decimals.
  SetupResult (*solve)(const std::string& path, int decimals);
  bool has_u;  ///< its file may state u
};

struct SetupArguments {
  std::string path;
  Results results;
  int decimals = 6;
  double coverage_factor = 2.0;
  bool large_errors = false, verbose = false, check = false;
};

int execute(const SetupArguments& options, const SetupCommand& which) {
  SetupResult result = which.solve(options.path, options.decimals);
  result.coverage_factor = options.coverage_factor;
  const Results& results = options.results;
  Outputs outputs(results.force);
  for (const SetupSource& source : result.sources) outputs.reads(source.file);
  results.name_to(outputs);
  outputs.check();
  if (options.check) return checked(outputs, "say where the part of " + options.path + " is");
  if (!result.setup.converged) {
    std::cerr << options.path << ": the six contacts do not converge: are the datum errors those "
              << "of this part?\n";
    return numerical;
  }
  if (const std::string why = size_trouble(result); !options.large_errors && !why.empty())
    throw InputError(options.path, why);
  results.write(outputs, "--output", [&] { return setup_errors_toml(result); });
  results.write(outputs, "--json", [&] { return setup_json(result); });
  outputs.commit();
  if (results.printed()) return done;
  if (options.verbose)
    std::cout << setup_text(result);
  else
    print_screen(setup_screen(result));
  std::cout << results.line("errors ", "--output") << results.line("result ", "--json");
  return done;
}

void add_setup_command(CLI::App* command, const SetupCommand& which, int& exit_code) {
  auto options = std::make_shared<SetupArguments>();
  command->add_option("file", options->path, which.file)->required();
  Results& results = options->results;
  results.add(*command, "-o,--output", "trueaxis.errors",
              "errors of the workpiece, X0W … C0W (TOML)");
  results.add(*command, "--json", "trueaxis.setup", "result (JSON); - prints it");
  add_option(*command, "--decimals", options->decimals,
             CLI::Range(least_frame_decimals, most_frame_decimals),
             "decimals of mm and degrees in the frames of controls (default 6)");
  command->add_flag("--large-errors", options->large_errors,
                    "accept a part or tips more than 10 mm or 5 degrees off");
  if (which.has_u) add_coverage_factor(*command, options->coverage_factor);
  add_usual(*command, options->results.force, options->check, &options->verbose);
  command->callback([options, which, &exit_code] { exit_code = execute(*options, which); });
}

}  // namespace

void add_setup_locators(CLI::App* command, int& exit_code) {
  add_setup_command(command,
                    {"locators: ideal and measured (TOML)",
                     [](const std::string& path, int decimals) {
                       return result_of(read_locate_toml(path), decimals);
                     },
                     true},
                    exit_code);
}

void add_setup_datums(CLI::App* command, int& exit_code) {
  add_setup_command(command,
                    {"nine datum errors, or points of the datums (TOML)",
                     [](const std::string& path, int decimals) {
                       return result_of(read_datum_toml(path), decimals);
                     },
                     false},
                    exit_code);
}

}  // namespace trueaxis::cli
