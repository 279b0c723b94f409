// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "diagnose/regression/joint.hpp"

namespace trueaxis::diagnose_detail {

/// The surface fitted to the readings less what the terms contribute, masked readings left out.
struct CleanedFit {
  FitResult fit;
  /// Its covariances without the influences (GUM type B) that the options state.
  std::vector<double> noise_covariance, axis_noise_covariance;
};

/// @param effect_mm contribution of the terms, one a reading
/// @param masked readings that do not count, by row, and why
/// @param ideal the fit of the stream itself: taken where nothing is taken off and nothing masked
CleanedFit fit_cleaned(const ProbeStream& stream, const FitOptions& options,
                       const std::vector<double>& effect_mm, const ObservationMask& mask,
                       const std::vector<Rejected>& masked, const FitResult* ideal = nullptr);

/// The same with u of axis and parameters from the joint covariance, so that what a term takes from
/// the axis widens it (Eq. 86).
/// @param between covariance of the base that other causes add, or nothing
FitResult extended_fit(CleanedFit cleaned, const Joint& joint, const Eigen::MatrixXd& between = {});

}  // namespace trueaxis::diagnose_detail
