// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// What a sensor makes of a position besides noise.
struct SensorLimits {
  double zero_mm = 0.0;  ///< taken off by a gauge
  double low_mm = -std::numeric_limits<double>::infinity();
  double high_mm = std::numeric_limits<double>::infinity();
  double quantisation_mm = 0.0;

  bool operator==(const SensorLimits&) const = default;
};

/// What the sensor's head meets, before noise, limits and rounding; noise can be drawn on it again
/// and again.
struct CleanStream {
  ProbeStream stream;                 ///< as it would be recorded without noise
  std::vector<double> value_mm;       ///< position of the contact (or of the ball's centre)
  std::vector<double> tan_incidence;  ///< of normal and probe line; empty unless noise needs it
  std::vector<signed char> away;      ///< the reading's sign of "away from the material"
  SensorLimits sensor;
};

/// Probes the part of a scenario; of the scenario's noise only what shapes the clean reading
/// counts. The instants of a jittered pass come from the scenario's seed.
/// @throws InputError as simulate() does.
CleanStream simulate_clean(const Scenario& scenario);

}  // namespace trueaxis::virtual_lathe
