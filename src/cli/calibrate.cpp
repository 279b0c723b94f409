// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>

#include "base/counted.hpp"
#include "calibrate/files/calibration_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "calibrate/files/measurement_csv.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/machine_options.hpp"
#include "cli/options.hpp"
#include "cli/results.hpp"
#include "cli/terminal.hpp"
#include "format/notes.hpp"
#include "format/outputs.hpp"
#include "machine/files/errors_files.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {
namespace {

struct CalibrateArguments {
  MachineOptions machine;
  std::vector<std::string> data;
  Results results;
  double coverage_factor = CalibrationOptions{}.coverage_factor;
  bool verbose = false, check = false;
};

int execute(const CalibrateArguments& options) {
  const Results& results = options.results;
  Outputs outputs(results.force);
  outputs.reads(options.machine.machine);
  for (const std::string& path : options.data) outputs.reads(path);
  results.name_to(outputs, options.machine.errors);
  MachineFile file;
  CalibrationOptions calibration;
  ErrorsOfFiles given;
  std::vector<MachineMeasurement> data;
  all_of({[&] { file = options.machine.read_machine(); }, [&] { outputs.check(); }});
  all_of({[&] { given = options.machine.read_errors_of(file); },
          [&] { data = read_measurements(options.data, file.machine); }});
  calibration.errors = given.errors;
  calibration.coverage_factor = options.coverage_factor;
  if (options.check) {
    std::size_t rows = 0;
    for (const MachineMeasurement& one : data) rows += one.rows();
    return checked(outputs,
                   "estimate the errors of " + file.machine.name + " from " + counted(rows, "row"));
  }
  std::optional<Waiting> waiting("calibration of " + file.machine.name);
  const Calibration found = calibrate(file.machine, data, calibration);
  waiting.reset();
  expect_no_mistake(file.machine, data, calibration, found, found.rms_after_mm);
  if (!found.converged) {
    std::cerr << options.data.front() << ": not converged: " << found.message << '\n';
    return numerical;
  }
  for (std::string beyond :
       {components_beyond_plausible(found), beyond_plausible(found, calibration)})
    if (!beyond.empty()) given.remarks.push_back(std::move(beyond));
  results.write(outputs, "--output", [&] { return errors_toml(found.errors, &file.machine); });
  results.write(outputs, "--json",
                [&] { return calibration_json(found, file.machine, given.remarks); });
  outputs.commit();
  if (results.printed()) return done;
  if (options.verbose)
    std::cout << calibration_text(found) << notes_screen(given.remarks);
  else
    print_screen(with_notes(calibration_screen(found), given.remarks));
  std::cout << results.line("errors ", "--output") << results.line("result ", "--json");
  return done;
}

}  // namespace

void add_calibrate(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<CalibrateArguments>();
  options->machine.add_machine_to(*command);
  command
      ->add_option("data", options->data,
                   "measurements (CSV) of kinds ball, bar, array, axis, together")
      ->required();
  options->machine.add_errors_to(*command);
  Results& results = options->results;
  results.add(*command, "-o,--output", "trueaxis.errors", "errors, those given and found (TOML)")
      ->required();
  results.add(*command, "--json", "trueaxis.calibration", "result (JSON); - prints it");
  add_coverage_factor(*command, options->coverage_factor);
  add_usual(*command, options->results.force, options->check, &options->verbose);
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
