// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/regression/joint.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// A fit that ended short of a minimum, or a face, has no point to diagnose.
bool is_diagnosable(const FitResult& fit);

/// How the part stands in every set-up of a fit, the ball's centre on its surface.
std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm);

/// What the base of a model of a surface is.
BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings);

/// ∂X of all terms, one per reading, mm.
std::vector<double> contribution(const LinearisationPoint& point,
                                 const std::vector<Hypothesis>& terms,
                                 const Eigen::VectorXd& coefficients);

/// The surface fitted to the readings less what the terms contribute, masked readings left out; u
/// of axis and parameters from the joint covariance, so that what a term takes from the axis widens
/// it.
/// @param between covariance of the base that other causes add, or nothing
FitResult extended_fit(const ProbeStream& stream, const FitOptions& options, const Joint& joint,
                       const std::vector<double>& effect_mm, const std::vector<Rejected>& masked,
                       const Eigen::MatrixXd& between = {});

}  // namespace trueaxis::diagnose_detail
