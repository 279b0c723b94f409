// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// Of every axis of the machine, where the data and the cutting moves of the program have it.
std::vector<AxisRange> axis_ranges(const MachineJob& job, const std::vector<ProgramEnd>& ends);

/// Whether the program has an axis beyond where it was measured: by more than a tenth of what was
/// measured. A rotary axis that was measured over 300° is known all round.
bool beyond_measured(const AxisRange& range);

}  // namespace trueaxis::machine_job
