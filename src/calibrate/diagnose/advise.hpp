// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/diagnose/plans.hpp"
#include "calibrate/diagnose/term.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "infer/dictionary_search.hpp"

namespace trueaxis::calibrate_detail {

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
