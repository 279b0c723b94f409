// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {

/// One scan: cos, sin (2π f x − turns θ).
struct Scan {
  PointColumn x = nullptr;
  double turns = 0.0;
  bool spindle = false;  ///< turns are of C
  double low = 0.0, high = 0.0;
  std::function<Hypothesis(double)> make;
  bool pattern = false;
  bool form = false;   ///< along the surface's normal: of the other sign at the rear
  bool counts = true;  ///< false: the same lines as another scan
  Extent left_out{0.0, 0.0};
};

/// Frequencies of lines that over a single pass are fewer cycles than Problem::fewest_cycles from
/// one per revolution. There they are a bend, and spirals, such as feed marks of nearly the lead,
/// a taper and a barrel. Both 0: there are no such lines.
Extent slow_lines(const Problem& problem, SpectralLine::In in);

/// The scans that a stream lets be made; of means those of the whole.
std::vector<Scan> scans_of(const Problem& problem);

/// An order of the part's or the spindle's angle, times a line along Z or in time.
Hypothesis pattern_line(double order, bool in_time, double frequency);

/// What a line is periodic in.
PointColumn column_of(SpectralLine::In in);

}  // namespace trueaxis::diagnose_detail
