// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "resimulate/diagnosis_scenario.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis::cli {

/// What the virtual lathe reads before and after, against what was measured. A gauge's zero is set
/// in the scenarios.
Resimulation resimulated(DiagnosedScenarios& scenarios, const ProbeStream& measured);

/// The same for every reference of a job; none where there is no diagnosis.
/// @param diagnoses trueaxis.diagnosis/1 of each reference; empty where there is none
std::vector<std::optional<Resimulation>> resimulate_job(const JobResult& result,
                                                        const std::vector<std::string>& diagnoses);

}  // namespace trueaxis::cli
