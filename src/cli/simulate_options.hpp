// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/results.hpp"
#include "cli/stream_options.hpp"
#include "format/file.hpp"
#include "format/json.hpp"
#include "format/outputs.hpp"

namespace trueaxis::cli {

/// What measured readings are not: a simulation is replaced without `--force`.
inline constexpr const char* simulated_stream = "trueaxis.simulated_stream";
inline constexpr const char* simulated_measurement = "trueaxis.simulated_measurement";

/// Options of `trueaxis simulate`: a scenario, or the diagnosis of a part to be measured again.
struct SimulateOptions {
  std::string scenario, diagnosis, table, program;
  Results results;
  std::optional<std::uint64_t> seed;
  StreamOptions stream;  ///< of the diagnosis; path empty: as the diagnosis names it
  double ball_radius_mm = 0.0;
  bool before = false, noise_free = false, compare = false, check = false;
};

/// Schema trueaxis.simulation/1: what was written, and from what. A stream or a measurement is a
/// file of its own.
/// @param rows readings of a stream, rows of a measurement
inline std::string simulation_json(const Outputs& outputs, const std::string& place,
                                   std::size_t rows, std::uint64_t seed) {
  return json_text(
      {{"schema", "trueaxis.simulation/1"},
       {"version", TRUEAXIS_VERSION},
       {"inputs", list_of(outputs.inputs(),
                          [](const std::string& path) -> Json {
                            return {{"file", path}, {"hash", content_hash(read_file(path))}};
                          })},
       {"output", place},
       {"rows", rows},
       {"seed", seed}});
}

/// `simulate --from DIAGNOSIS`.
int simulate_from(SimulateOptions& options);

/// A scenario with `[machine]`. The virtual machine reads balls on its table, or cuts a program and
/// reports how far the cut is off.
int simulate_machine(SimulateOptions& options);

}  // namespace trueaxis::cli
