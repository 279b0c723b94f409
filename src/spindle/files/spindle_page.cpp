// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "format/html.hpp"
#include "format/text_layout.hpp"
#include "spindle/files/spindle_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using fmt::format;

constexpr const char* style = R"(
:root { --ink: #1d2733; --quiet: #5b6673; --line: #d9dfe6; --paper: #fff; --link: #0b5a94; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ink: #e3e8ed; --quiet: #a9b3be; --line: #323c46; --paper: #14191f; --link: #7cc0ff;
    color-scheme: dark; }
  svg rect { fill: var(--paper); }
  svg text { fill: var(--ink); }
  svg circle { stroke: #4a5663; }
  svg .band { fill: #7d4a22; }
  svg .cloud { stroke: #74818e; }
  svg .motion { stroke: #ff9d57; }
  svg .form { stroke: #7cc0ff; }
}
body { margin: 0 auto; max-width: 1100px; padding: 16px; color: var(--ink); background: var(--paper);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
h1 { font-size: 24px; line-height: 1.2; overflow-wrap: anywhere; }
h2 { font-size: 19px; margin-top: 28px; }
summary { color: var(--link); cursor: pointer; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 400px), 1fr)); }
.plots svg { width: 100%; height: auto; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 14px; }
th, td { padding: 5px 9px; border-bottom: 1px solid var(--line); text-align: right; }
th:first-child { text-align: left; position: sticky; left: 0; background: var(--paper); }
.quiet { color: var(--quiet); font-size: 13.5px; }
)";

std::string row(const std::string& name, const std::vector<std::string>& cells) {
  std::string text = "<tr><th>" + escape_html(name) + "</th>";
  for (const std::string& cell : cells) text += "<td>" + escape_html(cell) + "</td>";
  return text + "</tr>\n";
}

std::string scrolled(const std::string& rows) {
  return "<div class=\"scroll\" tabindex=\"0\"><table>\n" + rows + "</table></div>\n";
}

std::string shown(const Estimate& estimate, double k) {
  return estimate.determined() ? layout::plus_minus(estimate, k, 1.0 / mm_per_um, "µm") : "–";
}

std::string values_of(const ErrorMotion& motion, bool axial, double k) {
  const bool across = motion.across_seen;
  const auto both = [&](const Estimate& along, const Estimate& beside) {
    std::vector<std::string> cells{shown(along, k)};
    if (across) cells.push_back(shown(beside, k));
    return cells;
  };
  std::string rows =
      row(format("± is U = k u, k = {:g}", k),
          across ? std::vector<std::string>{"sensitive direction", "across"}
                 : std::vector<std::string>{axial ? "along Z" : "sensitive direction"});
  if (axial && motion.fundamental.determined()) {
    rows += row("fundamental", {shown(motion.fundamental, k)});
    rows += row("residual synchronous", {shown(motion.residual, k)});
  }
  rows += row("synchronous", both(motion.sensitive.synchronous, motion.across.synchronous));
  rows += row("asynchronous", both(motion.sensitive.asynchronous, motion.across.asynchronous));
  rows += row("total", both(motion.sensitive.total, motion.across.total));
  if (motion.form.determined())
    rows += row(axial ? "form of the face" : "roundness of the part", {shown(motion.form, k)});
  return scrolled(rows);
}

std::string orders_of(const ErrorMotion& motion, double k) {
  const bool form = motion.form.determined();
  std::vector<std::string> head{"condition"};
  if (form) head.push_back("form: amplitude ± U, phase");
  head.push_back("motion");
  if (motion.across_seen) head.push_back("across");
  std::string rows = row("order", head);
  for (const SeparatedOrder& one : motion.orders) {
    std::vector<std::string> cells{std::isfinite(one.condition) ? format("{:.1f}", one.condition)
                                                                : "infinite"};
    if (form) cells.push_back(harmonic_text(one.form, k));
    cells.push_back(harmonic_text(one.sensitive, k));
    if (motion.across_seen) cells.push_back(harmonic_text(one.across, k));
    rows += row(std::to_string(one.order), cells);
  }
  return "<details><summary>Orders</summary>" + scrolled(rows) + "</details>\n";
}

std::string section(const ErrorMotion& motion, bool axial, double k) {
  const std::string title =
      axial ? "Axial error motion"
            : format("Radial error motion along {:g}°", motion.sensitive_rad / rad_per_deg);
  std::string plots;
  for (const std::string& plot : polar_svgs(motion, axial, k)) plots += plot;
  return "<section><h2>" + title + "</h2>\n" + values_of(motion, axial, k) +
         "<div class=\"plots\">\n" + plots + "</div>\n" + orders_of(motion, k) + "</section>\n";
}

}  // namespace

std::string spindle_page(const SpindleResult& result) {
  const double k = result.coverage_factor;
  std::string body, sources;
  for (std::size_t i = 0; i < result.sources.size(); ++i)
    sources += (i == 0 ? "" : ", ") + result.sources[i];
  if (result.radial) body += section(*result.radial, false, k);
  if (result.axial) body += section(*result.axial, true, k);
  for (const std::string& note : result.notes) body += "<p>" + escape_html(note) + "</p>\n";
  return std::string("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta name=\"generator\" content=\"trueaxis.spindle_report/1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>TrueAxis spindle</title>\n<style>" +
         style + "</style>\n</head>\n<body>\n<h1>Part and spindle</h1>\n<p class=\"quiet\">" +
         escape_html(sources) +
         "; values of ISO 230-7. Orange: what repeats, its band U; grey: every reading; blue: the "
         "part.</p>\n" +
         body + "</body>\n</html>\n";
}

}  // namespace trueaxis
