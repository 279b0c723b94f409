// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"

namespace trueaxis::diagnose_detail {

/// A line found in a scan, before it is refined.
struct Peak {
  Hypothesis hypothesis;
  double gain = 0.0;       ///< decrease of the sum of squares, the surface's own columns forgotten
  double step = 0.0;       ///< of the scanned frequency, half a resolution cell
  double frequency = 0.0;  ///< scanned variable: cycles per turn, s, mm
};

/// Periodograms of what is left, over everything a line can be periodic in.
struct Scans {
  std::vector<Peak> causes;    ///< of catalogued kinds, the best of each scan first
  std::vector<Peak> patterns;  ///< (order × Z frequency) and (order × time frequency)
  double bandwidth = 0.0;      ///< Σ of W = Δf √(4π var x) (Baluev 2008, eq. 5) over the scans
};

/// Eq. 72.
/// @param equations of the readings of `problem`
/// @param remainder_mm deviation minus base and terms, not whitened
/// @param means 1: all lines; more: only those that means of so many readings weaken by 10 %
Scans scan_lines(const Problem& problem, const NormalEquations& equations,
                 std::span<const double> remainder_mm, std::size_t means = 1);

/// The same hypothesis at another frequency of its scan.
Hypothesis at_frequency(const Hypothesis& hypothesis, double frequency);
double frequency_of(const Hypothesis& hypothesis);
/// Whether the hypothesis has a frequency that a scan has found.
bool is_line(const Hypothesis& hypothesis);
/// What a line is periodic in, of every reading.
const std::vector<double>& variable_of(const Hypothesis& line, const LinearisationPoint& point);

/// Σ⁻¹ times what is left, up to the innovation's variance: WᵀW e; 0 where a row does not count.
/// Eq. 66.
std::vector<double> weighted(const NormalEquations& equations,
                             std::span<const double> remainder_mm);

}  // namespace trueaxis::diagnose_detail
