// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "blind_machine/cases.hpp"

namespace trueaxis::blind_machine {

/// RMS of what errors predict of the tip against what the machine does, mm. There are 120 drawn
/// positions of the rotary axes and a ball that was not measured, within 30 mm of the first. The
/// place of that ball is fitted, as everyone must. Drift, slip and reversal are not there, and the
/// machine is cold.
double error_elsewhere_mm(const Case& one, const ErrorModel& predicted);

}  // namespace trueaxis::blind_machine
