// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <optional>

#include "base/diagnostics.hpp"
#include "cli/diagnosed_stream.hpp"
#include "cli/guarded.hpp"
#include "cli/simulate_options.hpp"
#include "cli/terminal.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "resimulate/files/comparison.hpp"
#include "simulate/files/scenario_files.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

int play(const SimulateOptions& options, const Diagnosis& diagnosis, const ProbeStream& as_read,
         Outputs& outputs) {
  const ProbeStream measured = as_diagnosed(as_read, diagnosis, options.ball_radius_mm);
  std::optional<Waiting> waiting("measuring the part of " + options.diagnosis + " again");
  DiagnosedScenarios scenarios = diagnosed_scenarios(diagnosis, measured, options.ball_radius_mm);
  const Resimulation again = resimulate(scenarios, diagnosis, measured);
  expect_read_as_then(options.diagnosis, diagnosis, measured, again.readings);
  const Results& results = options.results;
  if (results.asked("--output")) {
    lathe::Scenario scenario = options.before ? scenarios.before : scenarios.after;
    if (options.noise_free) scenario.noise = lathe::Noise{};
    if (options.seed) scenario.seed = *options.seed;
    const lathe::Simulation simulation = lathe::simulate_at(scenario, measured);
    write_stream_csv(simulation.stream, outputs.open(results["--output"]), simulated_stream);
    results.write(outputs, "--truth", [&] { return truth_json(simulation.truth); });
  }
  results.write(outputs, "--json",
                [&] { return comparison_json(again.comparison, options.diagnosis, measured); });
  outputs.commit();
  waiting.reset();
  if (!results.printed()) {
    std::cout << comparison_text(again.comparison);
    if (results.asked("--output"))
      std::cout << results["--output"] << ": " << measured.size() << " readings\n";
  }
  return done;
}

}  // namespace

int simulate_from(SimulateOptions& options) {
  const Diagnosis diagnosis = diagnosis_from_json(read_file(options.diagnosis), options.diagnosis);
  StreamOptions stream = options.stream;
  stream.path = diagnosed_stream_path(stream.path, options.diagnosis, diagnosis);
  Outputs outputs(options.results.force);
  options.results.name_to(outputs, {options.diagnosis, stream.path});
  ProbeStream measured;
  all_of({[&] { measured = stream.read(); }, [&] { outputs.check(); }});
  if (options.check)
    return checked(outputs, "measure the part of " + options.diagnosis + " again, " +
                                std::to_string(measured.size()) + " readings, and compare");
  return of_file(
      options.diagnosis, [&] { return play(options, diagnosis, measured, outputs); }, "diagnosis");
}

}  // namespace trueaxis::cli
