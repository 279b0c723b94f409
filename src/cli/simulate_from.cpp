// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_from.hpp"

#include <iostream>
#include <optional>

#include "base/diagnostics.hpp"
#include "cli/check.hpp"
#include "cli/diagnosed_stream.hpp"
#include "cli/guarded.hpp"
#include "cli/waiting.hpp"
#include "diagnose/files/diagnosis_json.hpp"
#include "format/file.hpp"
#include "format/outputs.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "resimulate/files/comparison.hpp"
#include "simulate/files/truth_json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

int play(const SimulateFromOptions& options, const Diagnosis& diagnosis,
         const ProbeStream& measured, Outputs& outputs) {
  std::optional<Waiting> waiting("measuring the part of " + options.diagnosis + " again");
  DiagnosedScenarios scenarios = diagnosed_scenarios(diagnosis, measured, options.ball_radius_mm);
  const Resimulation again = resimulate(scenarios, diagnosis, measured);
  expect_read_as_then(options.diagnosis, diagnosis, measured, again.readings);
  if (!options.output.empty()) {
    lathe::Scenario scenario = options.before ? scenarios.before : scenarios.after;
    if (options.noise_free) scenario.noise = lathe::Noise{};
    if (options.seed) scenario.seed = *options.seed;
    const lathe::Simulation simulation = lathe::simulate_at(scenario, measured);
    write_stream_csv(simulation.stream, outputs.open(options.output));
    if (!options.truth.empty()) outputs.write(options.truth, truth_json(simulation.truth));
  }
  if (!options.json.empty())
    outputs.write(options.json, comparison_json(again.comparison, options.diagnosis, measured));
  outputs.commit();
  waiting.reset();
  if (options.output != "-" && options.json != "-") {
    std::cout << comparison_text(again.comparison);
    if (!options.output.empty())
      std::cout << options.output << ": " << measured.size() << " readings\n";
  }
  return done;
}

}  // namespace

int simulate_from(const SimulateFromOptions& options) {
  const Diagnosis diagnosis = diagnosis_from_json(read_file(options.diagnosis), options.diagnosis);
  StreamOptions stream = options.stream;
  stream.path = diagnosed_stream_path(stream.path, options.diagnosis, diagnosis);
  Outputs outputs(options.force);
  outputs.reads(options.diagnosis);
  outputs.reads(stream.path);
  outputs.may_write(options.output, "trueaxis.stream");
  outputs.may_write(options.truth, "trueaxis.truth");
  outputs.may_write(options.json, "trueaxis.comparison");
  ProbeStream measured;
  all_of({[&] { measured = stream.read(); }, [&] { outputs.check(); }});
  if (options.check)
    return checked(outputs, "measure the part of " + options.diagnosis + " again, " +
                                std::to_string(measured.size()) + " readings, and compare");
  return of_file(
      options.diagnosis, [&] { return play(options, diagnosis, measured, outputs); }, "diagnosis");
}

}  // namespace trueaxis::cli
