// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// The errors of a job's machine with what is uncertain of them. Where all that the diagnosis found
/// are errors of the machine, they are taken as known and the measurement is calibrated beside
/// them, so that every other component error counts with its plausible size; their own covariance
/// is added. Beside a slip, a drift or a reversal, which a calibration has not, the errors are
/// those of the diagnosis, with the covariance of such a calibration.
ErrorModel job_errors(const MachineJob& job, const MachineDiagnosis& diagnosis);

}  // namespace trueaxis::machine_job
