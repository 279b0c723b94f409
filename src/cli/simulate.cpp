// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/simulate_options.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "simulate/files/scenario_files.hpp"
#include "simulate/machine/files/machine_scenario_files.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

/// The stream of a simulation, and what the virtual lathe knows of it.
void check_outputs(Outputs& outputs, const SimulateOptions& options) {
  options.results.name_to(outputs, {options.scenario});
  outputs.check();
}

/// The stream, and what else is asked for of a scenario.
void write_probed(const ProbeStream& stream, const lathe::Scenario& scenario, Outputs& outputs,
                  const SimulateOptions& options, const lathe::Truth* truth = nullptr) {
  const Results& results = options.results;
  const std::string& place = results["--output"];
  write_stream_csv(stream, outputs.open(place), simulated_stream);
  if (truth != nullptr) results.write(outputs, "--truth", [&] { return truth_json(*truth); });
  results.write(outputs, "--json",
                [&] { return simulation_json(outputs, place, stream.size(), scenario.seed); });
  outputs.commit();
  if (!results.printed())
    std::cout << place << ": " << stream.size() << " readings, seed " << scenario.seed << '\n';
}

/// The part is cut with the table first, then probed as the scenario plans.
void simulate_cut(const lathe::Scenario& scenario, const SimulateOptions& options) {
  Outputs outputs(options.results.force);
  lathe::CutProgram program = *scenario.cut;
  if (!options.table.empty()) program.table = options.table;
  const bool tabled = program.use != lathe::CutUse::none;
  if (tabled && program.table.empty()) {
    throw InputError(options.scenario,
                     "the cut needs a table: give [cut] table or --table, or use = \"none\"");
  }
  const lathe::CutTable table =
      tabled ? read_cut_table(program.table, program.tool.sense) : lathe::CutTable{};
  if (tabled) outputs.reads(program.table);
  check_outputs(outputs, options);
  if (options.check) {
    checked(outputs, "cut the part" + (tabled ? " with " + program.table : std::string()) +
                         " and probe it again");
    return;
  }
  const Waiting waiting("cut and probing of " + options.scenario);
  const lathe::CutPart part(program, table);
  write_probed(lathe::probe_cut(part, scenario.plan, scenario.noise, scenario.seed), scenario,
               outputs, options);
}

/// A scenario of a machine of several axes has a command of its own; here until the next release.
int forwarded(SimulateOptions& options) {
  std::cerr << "trueaxis: a scenario with [machine] is now for trueaxis machine simulate; "
               "simulate plays it until the next release\n";
  if (options.results.asked("--truth") || !options.table.empty())
    throw InputError(options.scenario,
                     "a machine has its errors file for a truth, and no table: leave --truth and "
                     "--table out");
  return simulate_machine(options);
}

int execute(SimulateOptions& options) {
  const Results& results = options.results;
  if (machine_scenario_kind(options.scenario) != MachineScenarioKind::none)
    return forwarded(options);
  if (!results.asked("--output")) throw CLI::RequiredError("--output");
  options.results.say("--json", "trueaxis.simulation");
  lathe::Scenario scenario = read_scenario_toml(options.scenario);
  if (options.seed) scenario.seed = *options.seed;
  if (scenario.cut) {
    if (results.asked("--truth"))
      throw InputError(options.scenario, "a cut has no truth file: the program is the truth");
    simulate_cut(scenario, options);
    return done;
  }
  if (!options.table.empty())
    throw InputError(options.scenario, "--table needs a scenario with [cut]");
  Outputs outputs(results.force);
  check_outputs(outputs, options);
  if (options.check) return checked(outputs, "probe the part of " + options.scenario);
  std::optional<Waiting> waiting("probing of " + options.scenario);
  const lathe::Simulation simulation = lathe::simulate_with_truth(scenario);
  waiting.reset();
  write_probed(simulation.stream, scenario, outputs, options, &simulation.truth);
  return done;
}

}  // namespace

void add_simulate(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  Results& results = options->results;
  auto* scenario = command->add_option("scenario", options->scenario, "scenario (TOML)");
  auto* diagnosis = command
                        ->add_option("--from", options->diagnosis,
                                     "diagnosis (JSON) whose part is measured again and compared")
                        ->type_name("FILE");
  diagnosis->excludes(scenario);
  command->add_option("--table", options->table, "correction table for the scenario's [cut]")
      ->type_name("FILE")
      ->excludes(diagnosis);
  command->add_option("--seed", options->seed, "seed of the noise (default the scenario's)");
  command->add_option("--stream", options->stream.path, "diagnosed stream, if it has moved")
      ->type_name("FILE")
      ->needs(diagnosis);
  command->add_flag("--before", options->before, "the ideal fit without the causes found")
      ->needs(diagnosis);
  command->add_flag("--noise-free", options->noise_free, "no noise")->needs(diagnosis);
  auto* compare =
      command->add_flag("--compare", options->compare, "print the comparison, write no stream")
          ->needs(diagnosis);
  options->stream.add_meaning_to(*command);
  options->stream.add_range_to(*command);
  StreamOptions::add_ball_radius(*command, options->ball_radius_mm)->needs(diagnosis);
  auto* output =
      results.add(*command, "-o,--output", simulated_stream, "stream (CSV); - prints it");
  compare->excludes(output);
  results.add(*command, "--truth", "trueaxis.truth", "true values of the virtual lathe (JSON)")
      ->needs(output);
  results.add(*command, "--json", "trueaxis.comparison",
              "comparison with --from, or seed and number of readings (JSON); - prints it");
  add_usual(*command, results.force, options->check);
  command->callback([options, &exit_code] {
    const Results& results = options->results;
    if (options->diagnosis.empty()) {
      if (options->scenario.empty()) throw CLI::RequiredError("scenario");
      if (options->stream.says_anything())
        throw CLI::ValidationError("--diameter, --radius, --relative, --nominal-radius-mm",
                                   "need --from");
      exit_code = execute(*options);
      return;
    }
    if (!results.asked("--output") && !results.asked("--json") && !options->compare)
      throw CLI::RequiredError("--output, --compare or --json");
    exit_code = simulate_from(*options);
  });
}

}  // namespace trueaxis::cli
