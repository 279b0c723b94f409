// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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

/// A lateral stream has at most five angles, the same in every revolution: lobes one more or one
/// less than that are no different from an eccentricity.
extern const JobCheck few_angles;

/// The measurement that a diagnosis asks for, as a remedy.
Reason measure(const NextMeasurement& next);

/// Why the axis of a diagnosed stream is not known, although its fit has one: a slip that is not
/// sure, what goes with the eccentricity, or what is left unexplained.
std::optional<Reason> why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis);

/// Takes the numbers of the axis out of a fit, and leaves those of its shape.
void withhold_axis(FitResult& fit, const std::string& why);

}  // namespace trueaxis
