// SPDX-License-Identifier: Apache-2.0
#include "report/assets.hpp"

extern "C" {
extern const char trueaxis_report_html_begin[], trueaxis_report_html_end[];
extern const char trueaxis_report_css_begin[], trueaxis_report_css_end[];
extern const char trueaxis_echarts_begin[], trueaxis_echarts_end[];
extern const char trueaxis_report_js_begin[], trueaxis_report_js_end[];
extern const char trueaxis_sweep_js_begin[], trueaxis_sweep_js_end[];
}

namespace trueaxis {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::string_view::size_type>(end - begin)};
}

}  // namespace

ReportAssets report_assets() {
  return {between(trueaxis_report_html_begin, trueaxis_report_html_end),
          between(trueaxis_report_css_begin, trueaxis_report_css_end),
          between(trueaxis_echarts_begin, trueaxis_echarts_end),
          between(trueaxis_report_js_begin, trueaxis_report_js_end),
          between(trueaxis_sweep_js_begin, trueaxis_sweep_js_end)};
}

}  // namespace trueaxis
