// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// By how much the axis of a reference's `association` is off that of least squares, from the same
/// readings, with the covariance that their noise gives this difference (Eq. 303), at z_ref of the
/// fit used. Nothing where the job states none, or least squares.
/// @throws Refusal where the readings give no such axis
std::optional<AxisEstimate> associated_difference(const PlannedJob& result, std::size_t reference);

}  // namespace trueaxis
