// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "job/check.hpp"

namespace trueaxis {

/// All that was found leaves half as much again as the noise that repeats, revolutions or a
/// standing spindle show of it.
extern const JobCheck left_unexplained;

/// A pattern of no known cause at one undulation per revolution, or anything found so near to it
/// that it hardly beats with the eccentricity over the stream: the axis takes its amplitude in,
/// whatever its u says; or a line of at most three cycles.
extern const JobCheck moves_with_axis;

/// The part moved within a pass, by more than U of the axis (Eq. 314).
extern const JobCheck moves_in_pass;

/// A lateral stream has at most six angles, the same in every revolution or nearly so: lobes one
/// more or one less than that are no different from an eccentricity.
extern const JobCheck few_angles;

/// The measurement that a diagnosis asks for, as a remedy.
Reason measure(const NextMeasurement& next);

/// Why the axis of a diagnosed stream is not known, although its fit has one: a slip that is not
/// sure or at an end, a move, what goes with the eccentricity, what is left unexplained, or angles
/// so few that lobes are no different from it. Every command asks here.
std::optional<Reason> why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis);

/// The same of a stream without a diagnosis.
std::optional<Reason> few_angles_of(const ProbeStream& stream);
std::optional<Reason> moved_reason(const ProbeStream& stream, std::span<const double> left_mm,
                                   const FitResult& fit);

/// Takes the numbers of the axis out of a fit, and leaves those of its shape.
void withhold_axis(FitResult& fit, const std::string& why);

}  // namespace trueaxis
