// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The whole decision about a job, from fits, diagnoses, resimulations, inclusions, target axis and
/// correction; Eq. 120. No go, in this order: references that do not
/// agree as those of one part; a fit that failed; a slip of the part; a cut
/// that is refused or that geometry forbids; an actuator that cannot follow; no uncertainty; a
/// motion that must not enter the correction; findings that the virtual lathe refutes (refuted()).
/// Not proven: something found that goes with the axis. Then the tolerance, and what is to be said
/// beside a go.
Verdict decide(const JobResult& result);

}  // namespace trueaxis
