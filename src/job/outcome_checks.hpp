// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// Every reference has a fit.
extern const JobCheck fits_converged;

/// The actuator follows the planned correction.
extern const JobCheck actuator_follows;

/// The numbers of the cut have an uncertainty.
extern const JobCheck uncertainty_known;

/// No motion that was asked into the correction must stay out of it.
extern const JobCheck motions_allowed;

/// The virtual lathe reproduces the readings with what was found (refuted()).
extern const JobCheck findings_reproduced;

/// "coaxiality at most 5.9 µm with the table, 221 µm without it" as a reason.
Reason expected_cut(const PlannedJob& job, const CutNumbers& cut);

}  // namespace trueaxis
