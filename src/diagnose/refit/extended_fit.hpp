// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "diagnose/regression/joint.hpp"

namespace trueaxis::diagnose_detail {

/// The surface fitted to the readings less what the terms contribute, without excluded readings.
struct CleanedFit {
  FitResult fit;
  /// Its covariances without the influences (GUM type B) that the options state.
  Covariance noise_covariance;
  AxisCovariance axis_noise_covariance;
};

/// @param effect_mm contribution of the terms, one a reading
/// @param masked rows that do not count, and why @param ideal the fit of the stream itself: used if
/// nothing is subtracted and nothing excluded
CleanedFit fit_cleaned(const ProbeStream& stream, const FitOptions& options,
                       std::vector<double> effect_mm, const ObservationMask& mask,
                       const std::vector<Rejected>& masked, const FitResult* ideal = nullptr);

/// What a stated influence leaves of the base, under its name in the budget.
struct StatedPart {
  std::string name;
  Eigen::MatrixXd covariance;
};

/// What is known of the base of a model.
struct BaseUncertainty {
  Eigen::MatrixXd within;          ///< covariance by the noise
  Eigen::MatrixXd between;         ///< what other causes add; empty: nothing
  std::vector<StatedPart> stated;  ///< shares of `between`
  double sigma_mm = 0.0;           ///< of a reading's innovation
  bool whitened = false;
};
inline BaseUncertainty uncertainty_of(const Joint& joint) {
  return {
      joint.base_covariance(), {}, {}, joint.sigma_mm, !joint.equations.autoregression().empty()};
}

/// The same with u of axis and parameters from the covariance of the joint fit's base, so that what
/// a term takes from the axis widens it (Eq. 86).
FitResult extended_fit(CleanedFit cleaned, const LinearisationPoint& point,
                       const BaseUncertainty& base);

}  // namespace trueaxis::diagnose_detail
