// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// The decision by ISO 14253-1 at a risk of 5 %. `numbers` has what the decision rests on: before,
/// after, between, U, not_corrected. The tip is off by at most what is left and not corrected, plus
/// U: |δ|² of a normal δ with the covariance's trace u² exceeds (2u)² in at most 5 of 100, which is
/// the case of one direction (Eq. 222).
MachineJobVerdict decide(const MachineJobResult& result, MachineJobVerdict numbers);

}  // namespace trueaxis::machine_job
