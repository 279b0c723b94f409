// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/measure/probe_stream.hpp"

namespace trueaxis {

/// Noise-free readings of a simulation with the ideal surface (before) and with the extended model
/// (after) at the arguments of a measured stream, one a reading, mm.
struct SimulatedReadings {
  std::vector<double> before_mm, after_mm;
};

/// An order of the spectrum of measured − simulated: amplitudes, mm.
struct ComparedLine {
  double order = 0.0;  ///< undulations per revolution
  double before_mm = 0.0, after_mm = 0.0;
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
  Discrepancy noise;                ///< what noise alone would leave
  std::vector<ComparedLine> lines;  ///< the largest of both spectra, largest first
};

/// @param sigma_mm standard deviation of a reading
Comparison compare(const ProbeStream& measured, const SimulatedReadings& simulated,
                   const std::vector<bool>& masked, double sigma_mm);

}  // namespace trueaxis
