// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "study/published/placement.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis {

/// The report of a sweep: one HTML page that opens offline (Apache ECharts embedded).
/// @param placement of published runs; may be null
std::string render_sweep_report(const study::Sweep& sweep, const study::Summary& summary,
                                const study::Placement* placement);

}  // namespace trueaxis
