// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// Schema trueaxis.errors_at/1: every component error of every axis at a position, and the location
/// errors that keep the form of the inverse kinematics (of five axes 30 and 9, Bohez 2002); under
/// `further` the other ones that are given. mm and degrees; `remarks` of the files that were read.
std::string errors_json(const Machine& machine, const ErrorModel& errors, const AxisPositions& axes,
                        const std::vector<std::string>& remarks);

/// The same for a terminal, µm and µrad; what is 0 is left out.
std::string errors_text(const Machine& machine, const ErrorModel& errors,
                        const AxisPositions& axes);

}  // namespace trueaxis
