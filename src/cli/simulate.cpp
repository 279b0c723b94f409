// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/simulate_from.hpp"
#include "cli/simulate_machine.hpp"
#include "cli/waiting.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "simulate/files/cut_table_csv.hpp"
#include "simulate/files/scenario_toml.hpp"
#include "simulate/files/truth_json.hpp"
#include "simulate/machine/files/scenario_machine.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

struct SimulateArguments {
  std::string scenario, stream, truth, table, program, json;
  std::optional<std::uint64_t> seed;
  bool force = false, check = false;
};

/// The stream of a simulation, and what the virtual lathe knows of it.
void check_outputs(Outputs& outputs, const SimulateArguments& options) {
  outputs.reads(options.scenario);
  outputs.may_write(options.stream, "trueaxis.stream");
  outputs.may_write(options.truth, "trueaxis.truth");
  outputs.check();
}

/// The part is cut with the table first, then probed as the scenario plans.
void simulate_cut(const lathe::Scenario& scenario, const SimulateArguments& options) {
  Outputs outputs(options.force);
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
  write_stream_csv(lathe::probe_cut(part, scenario.plan, scenario.noise, scenario.seed),
                   outputs.open(options.stream));
  outputs.commit();
}

/// A scenario with `[machine]`.
int simulate_machine(const SimulateArguments& options, MachineScenarioKind kind) {
  const bool cuts = kind == MachineScenarioKind::cut;
  if (!options.truth.empty() || !options.table.empty())
    throw InputError(options.scenario,
                     "a machine has its errors file for a truth, and no table: leave --truth and "
                     "--table out");
  if (cuts && options.seed)
    throw InputError(options.scenario, "a cut has no noise: leave --seed out");
  if (!cuts && !options.program.empty())
    throw InputError(options.scenario, "--program needs a scenario with [machine] and [cut]");
  const SimulateMachineOptions of_machine{options.scenario, options.stream, options.json,
                                          options.program,  options.seed,   options.force,
                                          options.check};
  return cuts ? simulate_machine_cut(of_machine) : simulate_measurement(of_machine);
}

int execute(const SimulateArguments& options) {
  const MachineScenarioKind kind = machine_scenario_kind(options.scenario);
  const bool cuts = kind == MachineScenarioKind::cut;
  if (options.stream.empty() && !cuts) throw CLI::RequiredError("--output");
  if (!options.json.empty() && !cuts)
    throw CLI::ValidationError("--json", "needs --from, or a scenario with [machine] and [cut]");
  if (kind != MachineScenarioKind::none) return simulate_machine(options, kind);
  if (!options.program.empty())
    throw InputError(options.scenario, "--program needs a scenario with [machine] and [cut]");
  lathe::Scenario scenario = read_scenario_toml(options.scenario);
  if (options.seed) scenario.seed = *options.seed;
  if (scenario.cut) {
    if (!options.truth.empty())
      throw InputError(options.scenario, "a cut has no truth file: the program is the truth");
    simulate_cut(scenario, options);
    return done;
  }
  if (!options.table.empty())
    throw InputError(options.scenario, "--table needs a scenario with [cut]");
  Outputs outputs(options.force);
  check_outputs(outputs, options);
  if (options.check) return checked(outputs, "probe the part of " + options.scenario);
  std::optional<Waiting> waiting("probing of " + options.scenario);
  const lathe::Simulation simulation = lathe::simulate_with_truth(scenario);
  waiting.reset();
  write_stream_csv(simulation.stream, outputs.open(options.stream));
  if (!options.truth.empty()) outputs.write(options.truth, truth_json(simulation.truth));
  outputs.commit();
  if (options.stream != "-") {
    std::cout << options.stream << ": " << simulation.stream.size() << " readings, seed "
              << scenario.seed << '\n';
  }
  return done;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "simulate",
      "probe a part in the virtual lathe; measure, or cut a program, on a virtual machine");
  auto options = std::make_shared<SimulateArguments>();
  auto from = std::make_shared<SimulateFromOptions>();
  auto* scenario = command->add_option("scenario", options->scenario, "scenario (TOML)");
  auto* diagnosis =
      command->add_option("--from", from->diagnosis,
                          "diagnosis (JSON) instead of a scenario: measure its part again, with "
                          "what was found, and compare");
  diagnosis->excludes(scenario);
  auto* output =
      command->add_option("-o,--output", options->stream, "the stream (CSV), '-' prints it")
          ->check(a_place());
  command->add_option("--truth", options->truth, "what the virtual lathe knows (JSON)")
      ->check(a_place())
      ->needs(output);
  command->add_option("--table", options->table, "correction table of the scenario's [cut]")
      ->excludes(diagnosis);
  command
      ->add_option("--program", options->program,
                   "a program that the machine cuts instead of that of the scenario's [cut], which "
                   "says what should be cut")
      ->excludes(diagnosis);
  command->add_option("--seed", options->seed, "instead of the scenario's");
  command->add_option("--stream", from->stream.path, "where the diagnosed stream is now")
      ->needs(diagnosis);
  command->add_flag("--before", from->before, "the ideal surface, without what was found")
      ->needs(diagnosis);
  command->add_flag("--noise-free", from->noise_free, "without noise")->needs(diagnosis);
  command->add_flag("--compare", from->compare, "print the comparison, write no stream")
      ->needs(diagnosis)
      ->excludes(output);
  command
      ->add_option("--json", from->json,
                   "write the comparison, or the judgement of a cut, here (JSON), '-' prints it")
      ->check(a_place());
  add_force(*command, options->force);
  add_check(*command, options->check);
  from->stream.add_meaning_to(*command);
  from->stream.add_range_to(*command);
  StreamOptions::add_ball_radius(*command, from->ball_radius_mm)->needs(diagnosis);
  command->callback([options, from, &exit_code] {
    if (from->diagnosis.empty()) {
      if (options->scenario.empty()) throw CLI::RequiredError("scenario");
      if (from->stream.says_anything())
        throw CLI::ValidationError("--diameter, --radius, --relative, --nominal-radius",
                                   "need --from");
      options->json = from->json;
      if (!options->json.empty() && options->json == options->stream)
        throw CLI::ValidationError("--json", "cannot go where --output goes");
      exit_code = execute(*options);
      return;
    }
    from->output = options->stream;
    from->truth = options->truth;
    from->seed = options->seed;
    from->force = options->force;
    from->check = options->check;
    if (from->output.empty() && from->json.empty() && !from->compare)
      throw CLI::RequiredError("--output, --compare or --json");
    if (!from->json.empty() && from->json == from->output)
      throw CLI::ValidationError("--json", "cannot go where --output goes");
    exit_code = simulate_from(*from);
  });
}

}  // namespace trueaxis::cli
