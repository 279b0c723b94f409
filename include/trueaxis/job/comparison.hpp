// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/diagnose/diagnosis.hpp"
#include "trueaxis/measure/probe_stream.hpp"

namespace trueaxis {

/// Noise-free readings of a simulation with the ideal surface (before) and with the extended model
/// (after) at the arguments of a measured stream, one a reading, mm.
struct SimulatedReadings {
  std::vector<double> before_mm, after_mm;
};

/// How far a simulation is from what was measured.
struct Discrepancy {
  double rms_mm = 0.0;  ///< of measured − simulated
  double share = 0.0;   ///< its variance over that of measured − ideal surface
};

/// Measured against simulated, before and after. Readings that are masked do not count.
struct Comparison {
  std::size_t readings = 0, masked = 0;
  Discrepancy before, after;
  Discrepancy noise;  ///< what noise alone would leave
  /// Amplitudes of measured − simulated over the order, in half resolution cells up to order 15 or
  /// half the sampling; none for less than half a turn.
  std::vector<SpectrumBin> spectrum;
  std::vector<SpectrumBin> lines;  ///< its largest, largest first
};

/// A diagnosed measurement taken again by the virtual lathe.
struct Resimulation {
  SimulatedReadings readings;
  Comparison comparison;
  std::string why_not;  ///< not empty: there is none, for this reason
};

/// @param sigma_mm standard deviation of a reading
Comparison compare(const ProbeStream& measured, const SimulatedReadings& simulated,
                   const std::vector<bool>& masked, double sigma_mm);

}  // namespace trueaxis
