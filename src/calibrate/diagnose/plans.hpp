// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "calibrate/diagnose/explain.hpp"

namespace trueaxis::calibrate_detail {

/// A further measurement and the data with it, in which the new rows read what the model predicts.
struct Plan {
  MachinePlan plan;
  std::vector<MachineMeasurement> data;
};

/// RV the same positions in reverse, L2 a tool 70 mm longer, B2 a ball 60 mm off in radius and
/// height. AC a grid of five positions of one rotary axis by every 30° of the other. Those that the
/// machine can do, on the first file of kind ball or bar. Of read-outs alone RV of each.
std::vector<Plan> plans_for(const Problem& problem, std::span<const MachineMeasurement> data,
                            const ErrorModel& errors, const VectorXd& places);

/// B1: a ball on the workpiece's body at a grid of rotary positions and back; nothing for a machine
/// that cannot. @param noise_mm σ of a reading
std::optional<Plan> first_plan(const Machine& machine, const ErrorModel& errors, double noise_mm);

}  // namespace trueaxis::calibrate_detail
