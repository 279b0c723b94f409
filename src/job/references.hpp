// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// "seat: ", before what is said of the i-th reference; empty: it has no name.
std::string of_reference(const JobResult& result, std::size_t i);

/// The axis of a reference as a cut is about it: stated, by its association, with what a slip may
/// have turned.
AxisEstimate axis_of_reference(const JobResult& result, std::size_t i);

/// The references of a job with a target as the target axis sees them: axis of the fit used,
/// weight, and the radius at which a tilt counts.
std::vector<Reference> references_of(const JobResult& result);

/// The same with the axes that the job wants the cut to be about.
std::vector<Reference> references_aimed_at(const JobResult& result);

/// What a reader of a go must know where the job does not take the stated axes; else empty.
std::string axis_reservation(const JobResult& result);

}  // namespace trueaxis
