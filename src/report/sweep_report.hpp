// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "study/sweep/summary.hpp"

namespace trueaxis {

/// What a study outside the library adds to the page: data, and a script that puts an object with
/// `sections(sweep)`, `errorSeries` and `spreadSeries(sweep, view, quantity)` into `studies`.
struct SweepReportAddition {
  std::string key;  ///< of the data on the page
  nlohmann::json data;
  std::string_view script;
};

/// The report of a sweep: one HTML page that opens offline (Apache ECharts embedded).
std::string render_sweep_report(const study::Sweep& sweep, const study::Summary& summary,
                                const std::vector<SweepReportAddition>& additions = {});

/// Six digits: keeps the page small and its bytes free of the last bits.
double to_six_digits(double value);

}  // namespace trueaxis
