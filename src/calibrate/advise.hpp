// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "calibrate/plans.hpp"
#include "calibrate/tip_fit.hpp"

namespace trueaxis::calibrate_detail {

/// What the plans are weighed for.
struct Questions {
  const TipFit& fit;
  std::span<const MachineMeasurement> data;
  const MachineDiagnoseOptions& options;
  SearchOptions search;
  double variance = 1.0;  ///< of a residual over its σ
};

/// Every effect that these rows do not show at its typical size, with the plans that do, and the
/// plans with what they show and tell apart (Eq. 182); the next plan, most a minute.
void advise(const Questions& questions, const Regression& regression,
            const std::vector<Term>& terms, MachineDiagnosis& out);

}  // namespace trueaxis::calibrate_detail
