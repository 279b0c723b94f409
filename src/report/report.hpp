// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The report of a job: one HTML page that opens offline (Apache ECharts embedded).
std::string render_report(const JobResult& result);

}  // namespace trueaxis
