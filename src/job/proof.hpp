// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// What would prove that the cut keeps its tolerance, from the bound that the covariances are: the
/// noise in them falls with the number of readings, that of the slopes also with the square of the
/// probed length; stated influences and what rival models leave fall with neither (Eq. 120).
/// @param allowed_mm the tolerance less what the actuator leaves
Reason what_would_prove(const PlannedJob& job, double allowed_mm);

}  // namespace trueaxis
