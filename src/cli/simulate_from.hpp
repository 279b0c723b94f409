// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/stream_options.hpp"

namespace trueaxis::cli {

/// `simulate --from DIAGNOSIS`.
struct SimulateFromOptions {
  std::string diagnosis, output, truth, json;
  StreamOptions stream;  ///< path empty: as the diagnosis names it
  double ball_radius_mm = 0.0;
  bool before = false, noise_free = false, compare = false, force = false, check = false;
  std::optional<std::uint64_t> seed;
};

int simulate_from(const SimulateFromOptions& options);

}  // namespace trueaxis::cli
