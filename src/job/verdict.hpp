// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The whole decision about a job, from fits, diagnoses, resimulations, inclusions, target axis and
/// correction. No go, in this order: references
/// that do not agree as those of one part; a fit that failed; a slip of the part; an actuator that
/// cannot follow; no uncertainty; a motion that must not enter the correction; findings that the
/// virtual lathe refutes (refuted()), so that the axis is that of a wrong model; a tolerance that
/// is not shown to be kept (ISO 14253-1: value + U lies within it).
Verdict decide(const JobResult& result);

}  // namespace trueaxis
