// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_machine.hpp"

#include <iostream>

#include "cli/check.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/waiting.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "simulate/machine/files/cut_output.hpp"
#include "simulate/machine/files/measurement_csv.hpp"
#include "simulate/machine/files/measurement_toml.hpp"

namespace trueaxis::cli {

int simulate_measurement(const SimulateMachineOptions& options) {
  MeasurementScenario scenario = read_measurement_toml(options.scenario);
  if (options.seed) scenario.plan.seed = *options.seed;
  Outputs outputs(options.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  outputs.reads(options.scenario);
  outputs.may_write(options.output, "trueaxis.measurement");
  outputs.check();
  if (options.check)
    return checked(outputs, "play the measurement of " + options.scenario + " on its machine");
  const auto rows =
      virtual_machine::measure(scenario.of.machine, scenario.of.errors, scenario.plan);
  outputs.write(options.output, measurement_csv(scenario.of.machine, scenario.plan, rows));
  outputs.commit();
  if (!is_standard_output(options.output)) {
    std::cout << options.output << ": " << rows.size() << " rows, seed " << scenario.plan.seed
              << '\n';
  }
  return done;
}

int simulate_machine_cut(const SimulateMachineOptions& options) {
  const CutScenario scenario = read_cut_scenario_toml(options.scenario, options.program);
  Outputs outputs(options.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  outputs.reads(options.scenario);
  outputs.may_write(options.output, "trueaxis.path");
  outputs.may_write(options.json, "trueaxis.cut");
  outputs.check();
  if (options.check)
    return checked(outputs, "cut the program on the machine of " + options.scenario);
  std::optional<Waiting> waiting("cut of the program");
  const virtual_machine::Cut cut =
      virtual_machine::cut(scenario.of.machine, scenario.of.errors, scenario.plan);
  waiting.reset();
  if (!options.output.empty()) outputs.write(options.output, cut_csv(cut));
  if (!options.json.empty()) outputs.write(options.json, cut_json(cut, scenario));
  outputs.commit();
  if (!is_standard_output(options.output) && options.json != "-")
    std::cout << cut_text(cut, scenario);
  return done;
}

}  // namespace trueaxis::cli
