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

/// Probes the part of a scenario at the arguments (C, Z, t, set-up) of a recorded stream instead of
/// a plan's: that stream with other readings, its `clean_mm` without noise. Speeds and feeds are
/// those of its passes; a stream without t and speed has neither. The scenario's plan only says how
/// the part stands in each set-up; u needs the scenario's u_start_mm and u_end_mm.
/// @throws InputError as simulate().
Simulation simulate_at(const Scenario& scenario, const ProbeStream& recorded);

}  // namespace trueaxis::virtual_lathe
