// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "calibrate/diagnose/explain.hpp"
#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "infer/dictionary_search.hpp"

namespace trueaxis::calibrate_detail {

/// A further measurement and the data with it, in which the new rows read what the model predicts.
struct Plan {
  MachinePlan plan;
  std::vector<MachineMeasurement> data;
};

/// RV the same positions in reverse, L2 a tool 70 mm longer, B2 a ball 60 mm off in radius and
/// height. AC a grid of five positions of one rotary axis by every 30° of the other. Those that the
/// machine can do, on the first file of kind ball or bar. Of read-outs alone RV of each.
std::vector<Plan> plans_for(const Problem& problem, std::span<const MachineMeasurement> data,
                            const ErrorModel& errors, const VectorXd& places);

/// B1: a ball on the workpiece's body at a grid of rotary positions and back; nothing for a machine
/// that cannot. @param noise_mm σ of a reading
std::optional<Plan> first_plan(const Machine& machine, const ErrorModel& errors, double noise_mm);

/// What the plans are weighed for.
struct Questions {
  const TipFit& fit;
  std::span<const MachineMeasurement> data;
  const MachineDiagnoseOptions& options;
  infer::SearchOptions search;
  double variance = 1.0;  ///< of a residual over its σ
  Set found = {};         ///< terms that were found, which are fitted together with all others
};

/// Every effect that these rows do not show for sure at its typical size after what was found. Also
/// what the plans show of them and tell apart (Eqs. 98-100, 182), and the next plan.
void advise(const Questions& questions, const infer::Dictionary& dictionary,
            const std::vector<Term>& terms, MachineDiagnosis& out);

/// The columns of all unknowns and of the places, over σ, that planned rows determine, and those
/// that they may determine. No row is read quite where it was planned.
MatrixXd planned_base(const MatrixXd& all, std::size_t unknowns);

}  // namespace trueaxis::calibrate_detail
