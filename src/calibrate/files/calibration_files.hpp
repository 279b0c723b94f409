// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/calibration.hpp"

namespace trueaxis {

/// Schema trueaxis.calibration/1: lengths in mm, angles in degrees, each with its unit.
/// @param remarks of the files of errors that it began with
std::string calibration_json(const Calibration& calibration, const Machine& machine,
                             const std::vector<std::string>& remarks);

/// For a terminal: µm and µrad.
std::string calibration_text(const Calibration& calibration);

}  // namespace trueaxis
