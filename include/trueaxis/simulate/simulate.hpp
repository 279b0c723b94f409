// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "trueaxis/measure/probe_stream.hpp"
#include "trueaxis/simulate/scenario.hpp"

namespace trueaxis::virtual_lathe {

/// What the stream does not say.
struct Truth {
  Scenario scenario;
  std::vector<double> clean_mm;           ///< readings without noise, before clipping and rounding
  std::vector<std::size_t> outlier_rows;  ///< 0-based
  std::vector<std::size_t> clipped_rows;  ///< probe.saturation
};

struct Simulation {
  ProbeStream stream;
  Truth truth;
};

/// Probes the part of a scenario: C, Z (X), t, pass and setup columns; C running. Same scenario,
/// same bits.
/// @throws InputError when the scenario contradicts itself, or the probe misses the part.
ProbeStream simulate(const Scenario& scenario);
Simulation simulate_with_truth(const Scenario& scenario);

}  // namespace trueaxis::virtual_lathe
