// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine_job.hpp"

namespace trueaxis {

/// The job of a machine in some ten lines for a person: verdict, what to do next, what was found,
/// what was changed, what the numbers rest on. Lines are not broken, their text stands in column 8.
/// The tip's U on it is that of the verdict: without what is not known of where the part stands.
std::string machine_job_screen(const MachineJobResult& result);

}  // namespace trueaxis
