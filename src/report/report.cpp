// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include "report/assets.hpp"
#include "report/page.hpp"
#include "report/report_data.hpp"

namespace trueaxis {

std::string render_report(const JobResult& result) {
  const ReportAssets assets = report_assets();
  const Json data = report_data(result);
  const std::string title = escape_html("TrueAxis report: " + job_title(result.job));
  const std::string verdict = escape_html(result.verdict.line);
  const std::string json = json_for_script(data);
  return fill_template(assets.html, {{"schema", "trueaxis.report/2"},
                                     {"title", title},
                                     {"verdict", verdict},
                                     {"style", assets.css},
                                     {"data", json},
                                     {"echarts", assets.echarts},
                                     {"script", assets.js}});
}

}  // namespace trueaxis
