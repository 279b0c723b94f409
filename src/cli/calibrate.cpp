// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "calibrate/files/calibration_files.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "cli/commands.hpp"
#include "cli/expect_no_mistake.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "cli/options.hpp"
#include "format/outputs.hpp"
#include "machine/files/errors_toml.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct Options {
  MachineOptions machine;
  std::vector<std::string> data;
  std::string output, json;
  bool force = false;
};

int execute(const Options& options) {
  const MachineFile file = options.machine.read_machine();
  CalibrationOptions calibration;
  calibration.errors = options.machine.read_errors_of(file);
  const auto data = read_measurements(options.data, file.machine);
  Outputs outputs(options.force);
  outputs.reads(options.machine.machine);
  for (const std::string& path : options.data) outputs.reads(path);
  for (const std::string& path : options.machine.errors) outputs.reads(path);
  outputs.may_write(options.output, "trueaxis.errors");
  outputs.may_write(options.json, "trueaxis.calibration");
  outputs.check();
  const Calibration found = calibrate(file.machine, data, calibration);
  expect_no_mistake(file.machine, data, calibration, found);
  if (!found.converged) {
    std::cerr << options.data.front() << ": not converged: " << found.message << '\n';
    return numerical;
  }
  outputs.write(options.output, errors_toml(found.errors, &file.machine));
  if (!options.json.empty()) outputs.write(options.json, calibration_json(found, file.machine));
  outputs.commit();
  if (options.json != "-" && options.output != "-") std::cout << calibration_text(found);
  return done;
}

}  // namespace

void add_calibrate(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("calibrate", "the errors of a machine from measurements on it");
  auto options = std::make_shared<Options>();
  options->machine.add_machine_to(*command);
  command
      ->add_option("data", options->data,
                   "measurements (CSV) of kinds ball, bar, array, axis: together they are one")
      ->required();
  options->machine.add_errors_to(*command);
  command
      ->add_option("-o,--output", options->output,
                   "write the errors here (TOML): those given and those found")
      ->required()
      ->check(a_place());
  command->add_option("--json", options->json, "write the result here, '-' prints it")
      ->check(a_place());
  add_force(*command, options->force);
  command->callback([options, &exit_code] {
    if (options->json == options->output)
      throw CLI::ValidationError("--json", "cannot go where -o goes");
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
