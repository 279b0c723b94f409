// SPDX-License-Identifier: Apache-2.0
#include "report/page.hpp"

#include <algorithm>

#include "trueaxis/error.hpp"

extern "C" {
extern const char trueaxis_report_html_begin[], trueaxis_report_html_end[];
extern const char trueaxis_report_css_begin[], trueaxis_report_css_end[];
extern const char trueaxis_echarts_begin[], trueaxis_echarts_end[];
extern const char trueaxis_report_js_begin[], trueaxis_report_js_end[];
extern const char trueaxis_machine_js_begin[], trueaxis_machine_js_end[];
extern const char trueaxis_sweep_js_begin[], trueaxis_sweep_js_end[];
}

namespace trueaxis {
namespace {

using Text = std::pair<std::string_view, std::string_view>;
using Substitute = std::pair<char, std::string_view>;

std::string_view between(const char* begin, const char* end) { return {begin, end}; }

std::string substituted(std::string_view text, std::initializer_list<Substitute> substitutes) {
  std::string out;
  out.reserve(text.size());
  for (const char letter : text) {
    const auto* found = std::ranges::find(substitutes, letter, &Substitute::first);
    out += found == substitutes.end() ? std::string_view(&letter, 1) : found->second;
  }
  return out;
}

}  // namespace

std::string_view job_script() { return between(trueaxis_report_js_begin, trueaxis_report_js_end); }
std::string_view machine_script() {
  return between(trueaxis_machine_js_begin, trueaxis_machine_js_end);
}
std::string_view sweep_script() { return between(trueaxis_sweep_js_begin, trueaxis_sweep_js_end); }

std::string page_of(std::string_view title, std::string_view verdict, const Json& data,
                    std::string_view script, const Json* result) {
  return fill_template(between(trueaxis_report_html_begin, trueaxis_report_html_end),
                       {{"schema", data.at("schema").get_ref<const std::string&>()},
                        {"title", escape_html(title)},
                        {"verdict", escape_html(verdict)},
                        {"tables", plain_tables(result ? *result : data)},
                        {"style", between(trueaxis_report_css_begin, trueaxis_report_css_end)},
                        {"data", json_for_script(data)},
                        {"echarts", between(trueaxis_echarts_begin, trueaxis_echarts_end)},
                        {"script", script}});
}

std::string json_for_script(const Json& data) {
  return substituted(data.dump(-1, ' ', true, Json::error_handler_t::replace),
                     {{'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}});
}

std::string fill_template(
    std::string_view page,
    std::initializer_list<std::pair<std::string_view, std::string_view>> texts) {
  std::string filled;
  for (;;) {
    const std::size_t open = page.find("{{");
    filled += page.substr(0, open);
    if (open == std::string_view::npos) return filled;
    const std::size_t close = page.find("}}", open);
    expects(close != std::string_view::npos, "a template whose places are closed");
    const std::string_view place = page.substr(open + 2, close - open - 2);
    const auto* found = std::ranges::find(texts, place, &Text::first);
    expects(found != texts.end(), "a text for every place of the template");
    filled += found->second;
    page.remove_prefix(close + 2);
  }
}

}  // namespace trueaxis
