// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// A reference whose axis depends on a model that the data leave open.
struct OpenAxis {
  std::size_t reference = 0;
  std::string why;  ///< by how much the diagnosis moved it, and what is open
};

/// Where the diagnosis moved the axis, within the cut, by more than its U against the ideal fit
/// while a cause of it has rivals or a pattern has no cause.
std::vector<OpenAxis> open_axes(const JobResult& result);

/// Why the axis of a diagnosed stream is not known, although its fit has one: a slip that is not
/// sure or at an end, what goes with the eccentricity, what is left unnamed, or angles so few that
/// lobes are no different from it. Every command asks here. Empty: nothing speaks against it.
std::string why_axis_unknown(const ProbeStream& stream, const Diagnosis& diagnosis);

/// Takes the numbers of the axis out of a fit, and leaves those of its shape.
void withhold_axis(FitResult& fit, const std::string& why);

/// A pattern of no known cause at one undulation per revolution, or
/// with anything found so near to it that it hardly beats with the eccentricity over the stream:
/// the axis takes its amplitude in, whatever its u says; or with a line of at most three
/// cycles. Empty: there is none.
std::string moves_with_axis(const ProbeStream& stream, const Diagnosis& diagnosis);

/// Of the first reference where a cause that is improbable by its size alone explains a finding as
/// well as the named one and would put the axis elsewhere by so much that the cut were far out of
/// the tolerance: how improbable it is nobody knows so well. With the measurement that tells the
/// two apart. Empty: there is none.
std::string improbable_and_far(const JobResult& result, double tolerance_mm);

/// All that was found leaves half as much again as the noise that
/// repeats, revolutions or a standing spindle show of it. Empty: there is none.
std::string left_unnamed(const Diagnosis& diagnosis);

/// That a lateral stream has at most six angles, the same in every revolution or nearly so: lobes
/// one more or one less than that are no different from an eccentricity. Empty: it has more.
std::string few_angles(const ProbeStream& stream);

/// What the models of the references leave open and a reader of a go must know, a sentence each.
std::vector<std::string> model_reservations(const JobResult& result);

}  // namespace trueaxis
