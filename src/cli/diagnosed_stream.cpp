// SPDX-License-Identifier: Apache-2.0
#include "cli/diagnosed_stream.hpp"

#include <filesystem>
#include <utility>

#include "resimulate/diagnosed_scenarios.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

std::string diagnosed_stream_path(const std::string& said, const std::string& diagnosis_path,
                                  const Diagnosis& diagnosis) {
  if (!said.empty()) return said;
  const std::string& named = diagnosis.baseline.source;
  const std::filesystem::path beside = std::filesystem::path(diagnosis_path).parent_path() / named;
  for (const std::filesystem::path& path : {std::filesystem::path(named), beside}) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return path.string();
  }
  throw InputError(diagnosis_path,
                   "its stream `" + named + "` is not there: say where it is with --stream");
}

ProbeStream as_diagnosed(ProbeStream measured, const Diagnosis& diagnosis, double ball_radius_mm) {
  FitOptions options;
  options.surface = diagnosis.baseline.surface;
  options.bore = diagnosis.baseline.bore;
  options.loss = diagnosis.baseline.loss;
  options.ball_radius_mm = ball_radius_mm;
  options.influences = diagnosis.known;
  return corrected_by_known(std::move(measured), options);
}

void expect_read_as_then(const std::string& diagnosis_path, const Diagnosis& diagnosis,
                         const ProbeStream& measured, const SimulatedReadings& simulated) {
  if (reads_as_then(diagnosis, measured, simulated)) return;
  throw InputError(diagnosis_path,
                   "the stream does not leave the residuals that it states: repeat the "
                   "--diameter, --relative, --nominal-radius-mm, --ball-radius-mm, --z-from-mm or "
                   "--z-to-mm of the diagnosis");
}

Resimulation measured_again(const std::string& diagnosis_path, const Diagnosis& diagnosis,
                            const ProbeStream& measured, double ball_radius_mm) {
  const std::string& hash = diagnosis.baseline.input_hash;
  if (hash != measured.input_hash) {
    throw InputError(diagnosis_path, "is the diagnosis of another stream: its input was " + hash +
                                         ", " + measured.source + " is " + measured.input_hash);
  }
  Resimulation again = resimulate(diagnosis, measured, ball_radius_mm);
  if (again.why_not.empty())
    expect_read_as_then(diagnosis_path, diagnosis, measured, again.readings);
  return again;
}

}  // namespace trueaxis::cli
