// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "blind_machine/judge.hpp"

namespace trueaxis::blind_machine {

/// The range of an axis over a plan.
std::pair<double, double> range_of(const Plan& plan, AxisName axis);

/// Every term that calibration.md lists for this machine and plan but ball.slip, which has a
/// row.
std::vector<Effect> catalogue(const Machine& machine, const Plan& plan);

/// The error of size 1.
ErrorTerm unit_polynomial(const ErrorName& name, int degree, double low, double high);

}  // namespace trueaxis::blind_machine
