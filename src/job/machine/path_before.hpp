// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "job/machine/part_displacement.hpp"

namespace trueaxis::machine_job {

/// The largest distance of the tip between the ends of cutting blocks from the straight lines that
/// the program has there, with the program as it was read and without the displacement of the part
/// as a whole.
/// @param ends of every move of the program, in its order
LargestInProgram off_between_before(const MachineModel& model, const std::vector<ProgramEnd>& ends,
                                    const RigidFit::Body& part);

}  // namespace trueaxis::machine_job
