// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/machine_toml.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct MachineArguments {
  std::string input, output, errors_output;
  bool force = false, check = false;
};

int execute(const MachineArguments& options) {
  const MachineFile file = read_machine_toml(options.input);
  if (!file.denavit_hartenberg)
    throw InputError(options.input, "has no [[dh]] rows: it is in the zero-position form already");
  const bool has_errors = !file.parameter_errors.terms.empty();
  if (has_errors && options.errors_output.empty())
    throw InputError(options.input,
                     "has errors of its parameters: say with --errors-output where they go as "
                     "location errors");
  if (!has_errors && !options.errors_output.empty())
    throw InputError(options.input, "has no errors of its parameters: leave out --errors-output");
  Outputs outputs(options.force);
  outputs.reads(options.input);
  outputs.may_write(options.output, "trueaxis.machine");
  outputs.may_write(options.errors_output, "trueaxis.errors");
  outputs.check();
  if (options.check) return checked(outputs, "convert " + options.input);
  outputs.write(options.output, machine_toml(file.machine));
  if (has_errors)
    outputs.write(options.errors_output, errors_toml(file.parameter_errors, &file.machine));
  outputs.commit();
  return done;
}

}  // namespace

void add_machine_import(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<MachineArguments>();
  command->add_option("dh", options->input, "machine with [[dh]] rows (TOML)")->required();
  add_place(*command, "-o,--output", options->output, "machine in the zero-position form (TOML)")
      ->required();
  add_place(*command, "--errors-output", options->errors_output,
            "errors of the parameters as location errors (TOML)");
  add_usual(*command, options->force, options->check);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
