// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "format/json.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis {

/// The report of a machine's job: one HTML page that opens offline (Apache ECharts embedded).
std::string render_machine_report(const MachineJobResult& result);

/// The page of a machine's diagnosis: that of a job without a program, its verdict and next step
/// those of the diagnosis. `program`: what each effect does on one (harm_object()), or null.
std::string render_machine_diagnosis_report(const MachineJobResult& result, const Json& program);

/// Everything the page shows (schema trueaxis.machine_report/1): diagnosis and compensation as
/// their files have them, and what the charts draw, the unit of a number in its key; NaN, which
/// JSON writes as null, where there is none.
Json machine_report_data(const MachineJobResult& result);

/// Points of a program that are drawn of a longer one.
inline constexpr std::size_t max_drawn_tips = 3000;

}  // namespace trueaxis
