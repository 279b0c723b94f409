// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_from.hpp"

#include <filesystem>
#include <iostream>

#include "cli/guarded.hpp"
#include "diagnose/files/diagnosis_read.hpp"
#include "format/file.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "resimulate/diagnosed_scenarios.hpp"
#include "resimulate/files/comparison_json.hpp"
#include "resimulate/files/comparison_text.hpp"
#include "simulate/files/truth_json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

/// As given, else as the diagnosis names it: from here, or beside the diagnosis.
std::string stream_path(const SimulateFromOptions& options, const std::string& named) {
  if (!options.stream.path.empty()) return options.stream.path;
  const std::filesystem::path beside =
      std::filesystem::path(options.diagnosis).parent_path() / named;
  for (const std::filesystem::path& path : {std::filesystem::path(named), beside}) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return path.string();
  }
  throw InputError(options.diagnosis,
                   "its stream `" + named + "` is not there: say where it is with --stream");
}

int play(const SimulateFromOptions& options, const Diagnosis& diagnosis,
         const ProbeStream& measured) {
  DiagnosedScenarios scenarios = diagnosed_scenarios(diagnosis, measured, options.ball_radius_mm);
  const Resimulation again = resimulate(scenarios, diagnosis, measured);
  if (!reads_as_then(diagnosis, measured, again.readings))
    throw InputError("diagnosis",
                     "the stream does not leave the residuals that it states: repeat the "
                     "--diameter, --relative, --nominal-radius or --ball-radius of the diagnosis");
  if (!options.output.empty()) {
    lathe::Scenario scenario = options.before ? scenarios.before : scenarios.after;
    if (options.noise_free) scenario.noise = lathe::Noise{};
    if (options.seed) scenario.seed = *options.seed;
    const lathe::Simulation simulation = lathe::simulate_at(scenario, measured);
    write_stream_csv(simulation.stream, options.output);
    if (!options.truth.empty()) write_file(options.truth, truth_json(simulation.truth));
  }
  if (!options.json.empty())
    write_file(options.json, comparison_json(again.comparison, options.diagnosis, measured));
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
  stream.path = stream_path(options, diagnosis.baseline.source);
  const ProbeStream measured = stream.read();
  try {
    return play(options, diagnosis, measured);
  } catch (const InputError& error) {  // of the diagnosis: under the name of its file
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& d : diagnostics) {
      if (d.file == "diagnosis") d.file = options.diagnosis;
    }
    throw InputError(std::move(diagnostics));
  }
}

}  // namespace trueaxis::cli
