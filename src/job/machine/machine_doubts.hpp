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

/// What was found and no program corrects, at the tip: reversals, drifts, patterns that no effect
/// explains, and harmonics of which the order may be another.
double not_corrected_mm(const MachineJobResult& result, const MachineModel& model,
                        const std::vector<Stand>& stands);

/// What holds for the numbers whatever the verdict.
Reasons machine_remarks(const MachineJobResult& result);

/// "measure also at positions of C between those measured", where the order of a harmonic is open;
/// none: no other plan tells it.
std::optional<Reason> between_positions(const MachineDiagnosis& diagnosis);

/// "plan L2: the same positions with a tool 70 mm longer (17 min)"; none: no plan tells more.
std::optional<Reason> next_plan(const MachineDiagnosis& diagnosis);

}  // namespace trueaxis::machine_job
