// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace trueaxis {

/// The files of the report pages, embedded by assets.S.
struct ReportAssets {
  std::string_view html;  ///< the template with its {{places}}
  std::string_view css;
  std::string_view echarts;   ///< Apache ECharts, as published
  std::string_view js;        ///< a job's page: its own scripts, one after the other
  std::string_view sweep_js;  ///< the same of a sweep's page
};

ReportAssets report_assets();

}  // namespace trueaxis
