// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"

namespace trueaxis::diagnose_detail {

/// A measurement that could be added to a stream: its readings' arguments and set-up.
struct CandidateMeasurement {
  std::string code, what;
  double minutes = 0.0;
  ProbeStream stream;  ///< what was measured and what would be, thinned
  std::vector<Clamping> clampings;
  double weight = 1.0;  ///< readings that one of the thinned stands for
};

/// The candidates: each after the passes measured, in the manner of the longest of them.
/// @param wave_mm half of it is the shift along Z; 0: a fifth of the length
std::vector<CandidateMeasurement> candidate_measurements(const ProbeStream& stream,
                                                         const LinearisationPoint& point,
                                                         const std::vector<Clamping>& clampings,
                                                         double wave_mm);

}  // namespace trueaxis::diagnose_detail
