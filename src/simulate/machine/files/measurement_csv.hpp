// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "simulate/machine/measure.hpp"

namespace trueaxis {

/// The rows of a measurement in the columns of its kind (docs/calibration.md), mm, degrees and µm.
std::string measurement_csv(const Machine& machine, const virtual_machine::MeasurementPlan& plan,
                            const std::vector<virtual_machine::MeasuredRow>& rows);

}  // namespace trueaxis
