// SPDX-License-Identifier: Apache-2.0
#include "report/sweep_report.hpp"

#include "report/assets.hpp"
#include "report/page.hpp"
#include "report/sweep_data.hpp"

namespace trueaxis {

std::string render_sweep_report(const study::Sweep& sweep, const study::Summary& summary,
                                const std::vector<SweepReportAddition>& additions) {
  const ReportAssets assets = report_assets();
  const std::string title = escape_html("TrueAxis sweep: " + sweep_title(sweep));
  const std::string what = escape_html(std::to_string(summary.cells.size()) + " cells of " +
                                       std::to_string(sweep.repeats) + " repeats");
  nlohmann::json data = sweep_data(sweep, summary);
  std::string script = "const studies = [];\n";
  for (const SweepReportAddition& addition : additions) {
    data[addition.key] = addition.data;
    script += addition.script;
  }
  script += assets.sweep_js;
  const std::string json = json_for_script(data);
  return fill_template(assets.html, {{"schema", "trueaxis.sweep_report/1"},
                                     {"title", title},
                                     {"verdict", what},
                                     {"style", assets.css},
                                     {"data", json},
                                     {"echarts", assets.echarts},
                                     {"script", script}});
}

}  // namespace trueaxis
