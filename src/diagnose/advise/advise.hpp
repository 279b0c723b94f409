// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/explain/observable.hpp"
#include "diagnose/geometry/linearisation_point.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A measurement that could be added to a stream: its readings' arguments and set-up.
struct CandidateMeasurement {
  std::string code, what;
  double minutes = 0.0;
  ProbeStream stream;  ///< what was measured and what would be, thinned
  std::vector<Clamping> clampings;
  double weight = 1.0;             ///< readings that one of the thinned stands for
  std::vector<ProbingRun> runs{};  ///< as of Diagnosis::runs
};

/// The candidates: each after the passes measured, in the manner of the longest of them.
/// @param wave_mm half of it is the shift along Z; 0: a fifth of the length
std::vector<CandidateMeasurement> candidate_measurements(const ProbeStream& stream,
                                                         const LinearisationPoint& point,
                                                         const std::vector<Clamping>& clampings,
                                                         double wave_mm);

CandidateMeasurement measurement_at_hand(const ProbeStream& stream, const LinearisationPoint& point,
                                         const std::vector<Clamping>& clampings);

/// How many times faster the spindle may turn while the readings a second stay as they are.
double fastest_ratio(const LinearisationPoint& point);

/// A pass back with the spindle so many times faster, in the same time.
/// @param off_centre_mm so far off the spindle's axis the part is clamped before, and probed at the
/// speed at hand too; 0: it stays
CandidateMeasurement faster_measurement(const ProbeStream& stream, const LinearisationPoint& point,
                                        const std::vector<Clamping>& clampings, double ratio,
                                        double off_centre_mm);

struct Advice {
  NextMeasurement next;
  std::vector<Separating> plans;                     ///< best first
  std::vector<std::vector<ProbingRun>> runs;         ///< one per plan
  std::vector<std::optional<Separating>> questions;  ///< one per question
  std::vector<std::optional<Separating>> hidden;     ///< one per hidden effect
};

/// The measurement that raises Φ(d/2) of the classes most per minute, from the Jacobians of what
/// was measured and of what each plan would add; without a class, the one that shows the most
/// harmful of the hidden effects (Eqs. 99, 100).
Advice advise(const Problem& problem, const Model& model, const ProbeStream& stream,
              const std::vector<Clamping>& clampings,
              const std::vector<AmbiguousFinding>& questions,
              const std::vector<Unobservable>& hidden, double sigma_mm);

}  // namespace trueaxis::diagnose_detail
