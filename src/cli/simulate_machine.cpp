// SPDX-License-Identifier: Apache-2.0
#include <iostream>

#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/simulate_options.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"

namespace trueaxis::cli {

int simulate_measurement(SimulateOptions& options) {
  Results& results = options.results;
  results.say("--output", "trueaxis.measurement");
  MeasurementScenario scenario = read_measurement_toml(options.scenario);
  if (options.seed) scenario.plan.seed = *options.seed;
  Outputs outputs(results.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  outputs.reads(options.scenario);
  results.name_to(outputs);
  outputs.check();
  if (options.check)
    return checked(outputs, "play the measurement of " + options.scenario + " on its machine");
  const auto rows =
      virtual_machine::measure(scenario.of.machine, scenario.of.errors, scenario.plan);
  outputs.write(results["--output"], measurement_csv(scenario.of.machine, scenario.plan, rows));
  outputs.commit();
  if (!results.printed()) {
    std::cout << results["--output"] << ": " << rows.size() << " rows, seed " << scenario.plan.seed
              << '\n';
  }
  return done;
}

int simulate_machine_cut(SimulateOptions& options) {
  Results& results = options.results;
  results.say("--output", "trueaxis.path");
  results.say("--json", "trueaxis.cut");
  const CutScenario scenario = read_cut_scenario_toml(options.scenario, options.program);
  Outputs outputs(results.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  outputs.reads(options.scenario);
  results.name_to(outputs);
  outputs.check();
  if (options.check)
    return checked(outputs, "cut the program on the machine of " + options.scenario);
  std::optional<Waiting> waiting("cut of the program");
  const virtual_machine::Cut cut =
      virtual_machine::cut(scenario.of.machine, scenario.of.errors, scenario.plan);
  waiting.reset();
  results.write(outputs, "--output", [&] { return cut_csv(cut); });
  results.write(outputs, "--json", [&] { return cut_json(cut, scenario); });
  outputs.commit();
  if (!results.printed()) std::cout << cut_text(cut, scenario);
  return done;
}

}  // namespace trueaxis::cli
