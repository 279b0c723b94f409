// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "job/check.hpp"

namespace trueaxis {

/// The axis of a reference as a cut is about it: stated, by its association, with what a slip may
/// have turned.
AxisEstimate axis_of_reference(const PlannedJob& job, std::size_t i);

/// The references of a job with a target as the target axis sees them: axis of the fit used,
/// weight, and the radius at which a tilt counts.
std::vector<Reference> references_of(const PlannedJob& job);

/// The same with the axes that the job wants the cut to be about.
std::vector<Reference> references_aimed_at(const PlannedJob& job);

/// The job does not take the stated axes.
extern const JobCheck axis_of_cut;

}  // namespace trueaxis
