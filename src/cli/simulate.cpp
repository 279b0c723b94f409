// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/simulate/simulate.hpp"

#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "trueaxis/base/error.hpp"
#include "trueaxis/io/cut_table_csv.hpp"
#include "trueaxis/io/file.hpp"
#include "trueaxis/io/scenario_toml.hpp"
#include "trueaxis/io/stream_csv.hpp"
#include "trueaxis/io/truth_json.hpp"
#include "trueaxis/simulate/cut.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

struct Options {
  std::string scenario, stream, truth, table;
  std::optional<std::uint64_t> seed;
};

/// The part is cut with the table first, then probed as the scenario plans.
void simulate_cut(lathe::Scenario scenario, const Options& options) {
  lathe::CutProgram program = *scenario.cut;
  if (!options.table.empty()) program.table = options.table;
  const bool tabled = program.use != lathe::CutUse::none;
  if (tabled && program.table.empty()) {
    throw InputError(options.scenario,
                     "the cut needs a table: give [cut] table or --table, or use = \"none\"");
  }
  const lathe::CutTable table =
      tabled ? read_cut_table(program.table, program.tool.sense) : lathe::CutTable{};
  const lathe::CutPart part(program, table);
  write_stream_csv(lathe::probe_cut(part, scenario.plan, scenario.noise, scenario.seed),
                   options.stream);
}

int execute(const Options& options) {
  lathe::Scenario scenario = read_scenario_toml(options.scenario);
  if (options.seed) scenario.seed = *options.seed;
  if (scenario.cut) {
    if (!options.truth.empty())
      throw InputError(options.scenario, "a cut has no truth file: the program is the truth");
    simulate_cut(std::move(scenario), options);
    return done;
  }
  if (!options.table.empty())
    throw InputError(options.scenario, "--table needs a scenario with [cut]");
  const lathe::Simulation simulation = lathe::simulate_with_truth(scenario);
  write_stream_csv(simulation.stream, options.stream);
  if (!options.truth.empty()) write_file(options.truth, truth_json(simulation.truth));
  if (options.stream != "-") {
    std::cout << options.stream << ": " << simulation.stream.size() << " readings, seed "
              << scenario.seed << '\n';
  }
  return done;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("simulate", "probe a part in the virtual lathe");
  auto options = std::make_shared<Options>();
  command->add_option("scenario", options->scenario, "scenario (TOML)")->required();
  command->add_option("-o,--output", options->stream, "the stream (CSV), '-' prints it")
      ->required();
  command->add_option("--truth", options->truth, "what the virtual lathe knows (JSON)");
  command->add_option("--table", options->table, "correction table of the scenario's [cut]");
  command->add_option("--seed", options->seed, "instead of the scenario's");
  command->callback([options, &exit_code] { exit_code = execute(*options); });
}

}  // namespace trueaxis::cli
