// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/uncertainty.hpp"
#include "surface/surface.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Turns a minimum into the result: what is determined, parameters with uncertainties and budget,
/// the axis of every set-up, what was rejected. Residuals move into the result.
void describe(const JointModel& model, const std::vector<PlacedSetUp>& set_ups,
              Association& association, ReadingNoise noise, const FitOptions& options,
              FitResult& result);

/// U of the fitted radius, mm: a smaller one is not shown to be any. 0 where there is none.
double radius_U_mm(const FitResult& fit);

/// A radius that is not above its U, or `for_sure` below 0 by its U, and what to do: the ball is
/// larger than the path of its centre. Empty: there is none.
std::string impossible_radius(const FitResult& fit, bool for_sure);

/// One to three readings so far from all others that they are a mistake (a lost decimal point): by
/// row, with what to do. Empty: there are none, or too many for one.
std::string gross_readings(const ProbeStream& stream);

/// What a fit takes of a stream although nothing says it, what of the stream it does not use, and
/// what looks like another unit of C; a sentence each. Only of a stream that was read from a file:
/// who fills one in a program knows what is in it.
std::vector<std::string> notes_on_input(const ProbeStream& stream, const SurfaceInfo& info);

/// Gives the apex k of a cone its coverage interval, of value and covariance of the parameters
/// (Eq. 36a); surfaces without an apex, and an apex without value or u, stay as they
/// are. Without an interval stays too a k whose half angle is within `coverage_factor` u of zero.
void add_apex_interval(std::vector<FitParameter>& parameters, const Covariance& covariance,
                       double coverage_factor);

}  // namespace trueaxis
