// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis {

/// Schema trueaxis.machine_diagnosis/1, keys as those of trueaxis.diagnosis: lengths in mm, angles
/// in degrees, each with its unit; a number that is not there is null beside the reason.
std::string machine_diagnosis_json(const MachineDiagnosis& diagnosis, const Machine& machine);

/// For a terminal: µm and µrad.
std::string machine_diagnosis_text(const MachineDiagnosis& diagnosis);

}  // namespace trueaxis
