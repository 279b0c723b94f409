// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnose/regression/joint.hpp"
#include "trueaxis/diagnosis.hpp"

namespace trueaxis::diagnose_detail {

/// σ of a reading from each source that the data have, the best one chosen; gaps and interruptions.
/// @param residual_mm readings minus the extended model
NoiseReport report_noise(const ProbeStream& stream, const Joint& joint,
                         const std::vector<double>& residual_mm, std::vector<Rejected> masked,
                         const std::optional<double>& stated_mm);

}  // namespace trueaxis::diagnose_detail
