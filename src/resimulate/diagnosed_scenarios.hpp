// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/resimulation.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// Where u = (position − z_mid)/z_half of a diagnosis comes from, and its clock.
struct LatheFrame {
  double z_mid_mm = 0.0, z_half_mm = 1.0;
  double time_start_s = 0.0, time_end_s = 0.0;
};

/// A fitted term as the virtual lathe has it: an effect by the catalogue's parameters, two or more
/// where the lathe has one phase or degree and the term several; a pattern as an effect extra.*.
/// @throws InputError for what the lathe cannot play: an effect that it does not have, a term that
/// is not fitted, a form of the part that changes with time.
std::vector<virtual_lathe::Effect> lathe_effects(const TermValue& term, const LatheFrame& frame);

/// A diagnosis as the virtual lathe plays it at the readings of its stream (see simulate_at). Both
/// have the stream's set-ups and the diagnosis' noise (σ, autoregression).
struct DiagnosedScenarios {
  virtual_lathe::Scenario before;  ///< the ideal fit, no effect
  virtual_lathe::Scenario after;   ///< the final fit with every cause and unexplained pattern
};

/// Reads of the diagnosis: status, surface, bore, axis and shape of both fits, and the axes of the
/// set-ups; u's frame; the terms; σ and autoregression of the noise. @param measured its stream:
/// set-ups, gauge and clock @param ball_radius_mm as given to the diagnosis; 0: what the stream
/// says @throws InputError when the diagnosis is of another stream (hash), a fit did not converge,
/// or the lathe cannot play a term.
DiagnosedScenarios diagnosed_scenarios(const Diagnosis& diagnosis, const ProbeStream& measured,
                                       double ball_radius_mm = 0.0);

/// What the virtual lathe reads before and after, against what was measured. A gauge's zero is set
/// in the scenarios.
Resimulation resimulate(DiagnosedScenarios& scenarios, const Diagnosis& diagnosis,
                        const ProbeStream& measured);

/// Whether the stream leaves the residuals that the diagnosis states of the ideal fit: else it was
/// read in other units than then.
bool reads_as_then(const Diagnosis& diagnosis, const ProbeStream& measured,
                   const SimulatedReadings& simulated);

/// A mark for each of `count` readings: whether its row is among those excluded.
std::vector<bool> marked(const std::vector<Rejected>& rows, std::size_t count);

}  // namespace trueaxis
