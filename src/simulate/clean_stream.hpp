// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// What a sensor makes of a position besides noise.
struct SensorLimits {
  double zero_mm = 0.0;  ///< subtracted by a gauge
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

/// The readings that noise of `seed` makes of a clean stream: as simulate() draws them, with faster
/// generators of its own. The errors of one seed are the same bits on every platform, but for those
/// of an `autoregression`, whose variates are Boost's, as simulate()'s are.
void draw_readings(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                   std::span<double> reading_mm);

/// The noise-free readings of a scenario at the arguments of a measured stream, mm.
///
/// A gauge's zero is in no scenario: it is set so that the mean difference over the readings that
/// are not `masked` is zero; `scenario.probe.relative_zero_mm` is given that value.
/// @throws InputError as simulate_at().
std::vector<double> resimulate(Scenario& scenario, const ProbeStream& measured,
                               const std::vector<bool>& masked);

}  // namespace trueaxis::virtual_lathe
