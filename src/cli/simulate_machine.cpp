// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/simulate_options.hpp"
#include "cli/terminal.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

namespace {

int simulate_measurement(SimulateOptions& options) {
  Results& results = options.results;
  results.say("--output", simulated_measurement);
  results.say("--json", "trueaxis.simulation");
  MeasurementScenario scenario = read_measurement_toml(options.scenario);
  if (options.seed) scenario.plan.seed = *options.seed;
  Outputs outputs(results.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  results.name_to(outputs, {options.scenario});
  outputs.check();
  if (options.check)
    return checked(outputs, "play the measurement of " + options.scenario + " on its machine");
  const auto rows =
      virtual_machine::measure(scenario.of.machine, scenario.of.errors, scenario.plan);
  outputs.write(results["--output"], measurement_csv(scenario.of.machine, scenario.plan, rows));
  results.write(outputs, "--json", [&] {
    return simulation_json(outputs, results["--output"], rows.size(), scenario.plan.seed);
  });
  outputs.commit();
  if (!results.printed()) {
    std::cout << results["--output"] << ": " << rows.size() << " rows, seed " << scenario.plan.seed
              << '\n';
  }
  return done;
}

int simulate_cut(SimulateOptions& options) {
  Results& results = options.results;
  results.say("--output", "trueaxis.path");
  results.say("--json", "trueaxis.cut");
  const CutScenario scenario = read_cut_scenario_toml(options.scenario, options.program);
  Outputs outputs(results.force);
  for (const std::string& path : scenario.of.read) outputs.reads(path);
  results.name_to(outputs, {options.scenario});
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

}  // namespace

int simulate_machine(SimulateOptions& options) {
  const std::string& path = options.scenario;
  const MachineScenarioKind kind = machine_scenario_kind(path);
  const bool cuts = kind == MachineScenarioKind::cut;
  if (kind == MachineScenarioKind::none)
    throw InputError(path, "has no [machine]: a lathe is for trueaxis simulate");
  if (cuts && options.seed) throw InputError(path, "a cut has no noise: leave --seed out");
  if (!cuts && !options.results.asked("--output")) throw CLI::RequiredError("--output");
  if (!cuts && !options.program.empty())
    throw InputError(path, "--program needs a scenario with [machine] and [cut]");
  return cuts ? simulate_cut(options) : simulate_measurement(options);
}

void add_machine_simulate(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  Results& results = options->results;
  command->add_option("scenario", options->scenario, "scenario with [machine] (TOML)")->required();
  command
      ->add_option("--program", options->program,
                   "program to cut instead of the one in [cut], which stays the nominal part")
      ->type_name("FILE");
  command->add_option("--seed", options->seed, "seed of the noise (default the scenario's)");
  results.add(*command, "-o,--output", simulated_measurement,
              "measurement, or path of the tip in a cut (CSV); - prints it");
  results.add(*command, "--json", "trueaxis.cut",
              "judgement of a cut, or seed and number of rows (JSON); - prints it");
  add_usual(*command, results.force, options->check);
  command->callback([options, &exit_code] { exit_code = simulate_machine(*options); });
}

}  // namespace trueaxis::cli
