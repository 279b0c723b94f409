// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate_from.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>

#include "cli/commands.hpp"
#include "cli/resimulation.hpp"
#include "format/file.hpp"
#include "resimulate/diagnosis_scenario.hpp"
#include "resimulate/files/comparison_json.hpp"
#include "simulate/files/truth_json.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::cli {
namespace {

namespace lathe = virtual_lathe;

/// As given, else as the diagnosis names it: from here, or beside the diagnosis.
std::string stream_path(const SimulateFromOptions& options, const DiagnosisInput& input) {
  if (!options.stream.path.empty()) return options.stream.path;
  const std::filesystem::path beside =
      std::filesystem::path(options.diagnosis).parent_path() / input.file;
  for (const std::filesystem::path& path : {std::filesystem::path(input.file), beside}) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return path.string();
  }
  throw InputError(options.diagnosis,
                   "its stream `" + input.file + "` is not there: say where it is with --stream");
}

/// Else the two would be compared in different units.
void expect_read_as_then(const SimulateFromOptions& options, const ProbeStream& measured,
                         const SimulatedReadings& simulated, const DiagnosedScenarios& scenarios) {
  constexpr double rounding_mm = 1e-6;
  const double sigma_mm = scenarios.after.noise.sigma_mm, stated_mm = scenarios.rms_mm;
  const Comparison first = compare(measured, simulated, scenarios.rejected, sigma_mm);
  if (std::abs(first.before.rms_mm - stated_mm) <= 0.01 * stated_mm + rounding_mm) return;
  throw InputError(options.diagnosis,
                   "the stream does not leave the residuals that it states: repeat the --diameter, "
                   "--relative, --nominal-radius or --ball-radius of the diagnosis");
}

}  // namespace

int simulate_from(const SimulateFromOptions& options) {
  const std::string text = read_file(options.diagnosis);
  StreamOptions stream = options.stream;
  stream.path = stream_path(options, diagnosis_input(text, options.diagnosis));
  const ProbeStream measured = stream.read();
  DiagnosedScenarios scenarios =
      diagnosed_scenarios(text, options.diagnosis, measured, options.ball_radius_mm);
  const Resimulation again = resimulated(scenarios, measured);
  expect_read_as_then(options, measured, again.readings, scenarios);

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

}  // namespace trueaxis::cli
