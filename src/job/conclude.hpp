// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The second half of `run_job`: target axis, correction and verdict of references that are fitted
/// and, but for faces, diagnosed and measured again by the virtual lathe.
JobResult conclude(IdentifiedJob identified, std::vector<PartForm> forms = {});

/// The whole decision about a job, from what is identified, planned and assessed of its form; Eq.
/// 120. Made of checks(): no go where the first finds what forbids a cut; not proven where one
/// leaves the axis open; then the tolerance, and the reservations of a go.
Verdict decide(const PlannedJob& job, std::span<const PartForm> forms = {});

/// What would prove that the cut keeps its tolerance, from the bound that the covariances are (Eq.
/// 120). The noise in them falls with the number of readings, that of the slopes also with the
/// square of the probed length. Stated influences and what other models leave fall with neither.
/// @param allowed_mm the tolerance less what the actuator leaves
Reason what_would_prove(const PlannedJob& job, double allowed_mm);

}  // namespace trueaxis
