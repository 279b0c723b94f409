// SPDX-License-Identifier: Apache-2.0
#include "report/sweep_report.hpp"

#include "report/assets.hpp"
#include "report/page.hpp"
#include "report/sweep_data.hpp"

namespace trueaxis {

std::string render_sweep_report(const study::Sweep& sweep, const study::Summary& summary,
                                const study::Placement* placement) {
  const ReportAssets assets = report_assets();
  const std::string title = escape_html("TrueAxis sweep: " + sweep_title(sweep));
  const std::string what = escape_html(std::to_string(summary.cells.size()) + " cells of " +
                                       std::to_string(sweep.repeats) + " repeats");
  const std::string json = json_for_script(sweep_data(sweep, summary, placement));
  return fill_template(assets.html, {{"title", title},
                                     {"verdict", what},
                                     {"style", assets.css},
                                     {"data", json},
                                     {"echarts", assets.echarts},
                                     {"script", assets.sweep_js}});
}

}  // namespace trueaxis
