// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The datum system that the job names (ISO 5459). One cylinder or cone is its own axis. Several in
/// one datum share one axis with radii of their own, by least squares of all readings (Eq. 304). A
/// face that is named first gives the direction, and the second the place, held to it (Eq. 305).
/// Nothing where the job names none. @throws Refusal where the readings leave the axis open
std::optional<TargetDatum> target_datum(const PlannedJob& job);

/// What the target axis is solved for and a tolerance is compared with: the datum where the job
/// names one, else the references themselves.
std::vector<Reference> judged(const PlannedJob& job, const std::vector<Reference>& references);

/// The one axis of the references of a common datum, whatever the job holds it to (Eq. 304).
Axis shared_axis(const PlannedJob& job, const std::vector<std::string>& names);

}  // namespace trueaxis
