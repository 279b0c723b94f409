// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "job/machine/tip_uncertainty.hpp"

namespace trueaxis::machine_job {

/// Why there is no go, whatever the tolerance.
std::optional<Reason> machine_objection(const MachineJobResult& result);

/// An error that was found on a part of an axis' travel and that the program uses beyond it.
std::optional<Reason> extrapolated(const MachineJobResult& result);

/// What leaves a go with reservations.
Reasons machine_reservations(const MachineJobResult& result);

/// What was found and no program corrects: the sizes of reversals and drifts at the tip, and the
/// patterns that no effect explains.
double not_corrected_mm(const MachineJobResult& result, const MachineModel& model,
                        const std::vector<Stand>& stands);

/// What holds for the numbers whatever the verdict.
Reasons machine_remarks(const MachineJobResult& result);

/// "plan L2: the same positions with a tool 70 mm longer (17 min)"; none: no plan tells more.
std::optional<Reason> next_plan(const MachineDiagnosis& diagnosis);

}  // namespace trueaxis::machine_job
