// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "diagnose/regression/normal_equations.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A stream about its ideal fit: what a diagnosis starts from.
class IdealModel {
 public:
  /// Stream, options and fit outlive this. @param ideal is_diagnosable()
  /// @param indicated distinct_values() of the readings
  IdealModel(const ProbeStream& measured, const DiagnoseOptions& options, const FitResult& ideal,
             const DistinctValues& indicated);
  IdealModel(const IdealModel&) = delete;
  IdealModel& operator=(const IdealModel&) = delete;

  /// Excludes readings that are far from a model found, which what it explains hid.
  /// @param columns of the model @returns whether there are some: then a search has to be made
  /// again
  bool exclude_far_from(const std::vector<double>& residual_mm, std::size_t columns);

  const ProbeStream& stream;
  const FitOptions& fit_options;
  const FitResult& fit;
  const DistinctValues indication;
  const double ball_mm;
  const LinearisationPoint point;
  ObservationMask mask;
  const Resolution resolution;
  const std::vector<double> deviation_mm;  ///< readings minus the surface
  const Problem problem;
  std::vector<Rejected> masked;  ///< readings that do not count, and why
};

}  // namespace trueaxis::diagnose_detail
