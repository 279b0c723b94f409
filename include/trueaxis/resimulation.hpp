// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trueaxis/diagnosis.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// Noise-free readings of a simulation with the ideal fit (before) and with what was found (after)
/// at the arguments of a measured stream, one per reading, mm.
struct SimulatedReadings {
  std::vector<double> before_mm, after_mm;
};

/// How far a simulation is from what was measured.
struct Discrepancy {
  double rms_mm = 0.0;  ///< of measured − simulated
  double share = 0.0;   ///< its variance over that of measured − ideal fit
};

/// Measured against simulated, before and after. Readings that are masked do not count.
struct Comparison {
  std::size_t readings = 0, masked = 0;
  Discrepancy before, after;
  Discrepancy noise;  ///< what noise alone would leave
  /// λ of measured = after + λ (before − after) + noise, by least squares about the mean: 0 where
  /// what was found is right; above ½ exactly where more of the variance is left than before. u is
  /// that of the diagnosis' noise. Not determined where the two simulations are the same.
  Estimate j_test_lambda;
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

/// Measures the part of a diagnosis again at the arguments of its stream: the ideal fit, and the
/// final surface with all that was found. What the virtual lathe cannot play is data: see
/// Resimulation::why_not. @param ball_radius_mm as given to the diagnosis; 0: what the stream says
Resimulation resimulate(const Diagnosis& diagnosis, const ProbeStream& measured,
                        double ball_radius_mm = 0.0);

/// Eqs. 103, 104.
/// @param sigma_mm standard deviation of a reading
/// @param autoregression φ of its noise ε_i = Σ φ_j ε_{i−j} + e_i; empty: white
Comparison compare(const ProbeStream& measured, const SimulatedReadings& simulated,
                   const std::vector<bool>& masked, double sigma_mm,
                   const std::vector<double>& autoregression = {});

/// Whether the causes are refuted: more is left with them than without (λ > ½), and the difference
/// is significant (λ > 2.33 u, 1 % on one side). Both differences hold the same noise; for right
/// causes λ is 0 with the standard uncertainty u. This is the C test of Davidson & MacKinnon,
/// Econometrica 49 (1981) 781, of two models that do not contain each other. Significance alone
/// would refute too much: linearised terms move λ of a right cause (a nonlinearity of 20 µm: 0.2)
/// (Eq. 105).
bool refuted(const Comparison& comparison);

}  // namespace trueaxis
