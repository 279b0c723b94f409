// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/sweep_report.hpp"
#include "studies/published/placement.hpp"

namespace trueaxis {

/// The published runs, the readings of them and what remains open, for the page of the sweep;
/// nothing if they cannot be placed.
std::vector<SweepReportAddition> published_page(const study::Sweep& sweep,
                                                const study::Published& published,
                                                const study::Placement& placement);

}  // namespace trueaxis
