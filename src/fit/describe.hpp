// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/uncertainty.hpp"

namespace trueaxis {

/// Turns a minimum into the result: what is determined, parameters with uncertainties and budget,
/// the axis of every set-up, what was rejected. Residuals move into the result.
void describe(const JointModel& model, const std::vector<PlacedSetUp>& set_ups,
              Association& association, const ReadingNoise& noise, const FitOptions& options,
              FitResult& result);

}  // namespace trueaxis
