// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/geometry/linearisation_point.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::diagnose_detail {

/// A fit that ended short of a minimum, or a face, has no point to diagnose.
bool is_diagnosable(const FitResult& fit);

/// How the part stands in every set-up of a fit, the ball's centre on its surface.
std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm);

/// What the base of a model of a surface is.
BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings);

/// Readings minus the point's surface, of a gauge less its zero, which the base takes out anyway.
std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point);

}  // namespace trueaxis::diagnose_detail
