// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/diagnosis.hpp"

namespace trueaxis {

/// Schema trueaxis.diagnosis/2: lengths in mm, angles in degrees, times in s, each with its unit; a
/// number that is not there is null beside the reason. `findings[].term` and `unexplained[].term`
/// hold
/// the extended model as numbers, over u = (z − z_mid)/z_half of `u_frame`.
std::string diagnosis_json(const Diagnosis& diagnosis);

}  // namespace trueaxis
