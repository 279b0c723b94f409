// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "format/json.hpp"
#include "trueaxis/job.hpp"

namespace trueaxis {

/// The charts of one reference: maps, sections, residuals, histogram; thinned above
/// `max_points` readings.
Json readings_data(const ProbeStream& stream, const FitResult& fit);

}  // namespace trueaxis
