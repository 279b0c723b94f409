// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/number.hpp"
#include "base/text.hpp"
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
  return estimate.determined() || estimate.interval ? value_text(estimate, k) : "–";
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
  if (motion.form_seen())
    rows += row(axial ? "form of the face" : "roundness of the part", {shown(motion.form, k)});
  return scrolled(rows);
}

std::string orders_of(const ErrorMotion& motion, double k) {
  const bool form = motion.form_seen();
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
  std::string body;
  if (result.radial) body += section(*result.radial, false, k);
  if (result.axial) body += section(*result.axial, true, k);
  for (const std::string& note : result.notes) body += "<p>" + escape_html(note) + "</p>\n";
  return std::string("<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n") +
         "<meta name=\"generator\" content=\"trueaxis.spindle_report/1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<title>TrueAxis spindle</title>\n<style>" +
         style + "</style>\n</head>\n<body>\n<h1>Part and spindle</h1>\n<p class=\"quiet\">" +
         escape_html(word_list(result.sources)) +
         "; values of ISO 230-7. Orange: what repeats, its band U; grey: every reading; blue: the "
         "part.</p>\n" +
         body + "</body>\n</html>\n";
}

namespace {

constexpr double side = 420.0, middle = 0.5 * side, base = 90.0, room = 70.0;  // px

/// One polar plot: a base circle, values outwards from it, `room` for the largest of them.
class PolarPlot {
 public:
  PolarPlot(double left, std::string title, double largest_mm)
      : left_(left), title_(std::move(title)), per_step_mm_(step_for(largest_mm)) {}

  void line(std::span<const double> angle_rad, std::span<const double> value_mm, const char* of,
            const char* colour) {
    std::string path;
    for (std::size_t i = 0; i < angle_rad.size(); ++i)
      add_point(path, i == 0 ? 'M' : 'L', angle_rad[i], value_mm[i]);
    body_ +=
        format("<path class=\"{}\" d=\"{}Z\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
               of, path, colour);
  }

  void band(std::span<const double> angle_rad, std::span<const double> value_mm,
            std::span<const double> half_mm) {
    std::string path;
    for (const double sign : {1.0, -1.0}) {
      for (std::size_t i = 0; i < angle_rad.size(); ++i)
        add_point(path, i == 0 ? 'M' : 'L', angle_rad[i], value_mm[i] + sign * half_mm[i]);
      path += 'Z';
    }
    body_ +=
        format("<path class=\"band\" d=\"{}\" fill=\"#f4b183\" fill-rule=\"evenodd\"/>\n", path);
  }

  void cloud(std::span<const double> angle_rad, std::span<const double> value_mm) {
    std::string path;
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      add_point(path, 'M', angle_rad[i], value_mm[i]);
      path += "h.8";
    }
    body_ +=
        format("<path class=\"cloud\" d=\"{}\" stroke=\"#9aa7b4\" stroke-width=\".8\"/>\n", path);
  }

  std::string svg(const std::string& caption) const {
    std::string text = format("<g transform=\"translate({:.0f},30)\">\n", left_);
    for (int k = -1; k <= 1; ++k)
      text += format(
          "<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"#ccd3da\" "
          "stroke-dasharray=\"{2}\"/>\n",
          middle, base + k * room, k == 0 ? "none" : "3 4");
    for (int quarter = 0; quarter < 4; ++quarter) {
      const double angle = 0.25 * two_pi * quarter, r = base + room + 14.0;
      text +=
          format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}°</text>\n",
                 middle + r * std::cos(angle), middle - r * std::sin(angle) + 4.0, 90 * quarter);
    }
    text += body_;
    text +=
        format("<text x=\"{}\" y=\"-8\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\n",
               middle, title_);
    text += format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", middle, side - 8.0,
                   caption);
    text += format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">circles {} apart</text>\n",
                   middle, side + 8.0, layout::um(per_step_mm_));
    return text + "</g>\n";
  }

 private:
  /// 1, 2 or 5 times a power of ten.
  static double step_for(double largest_mm) {
    if (!(largest_mm > 0.0)) return mm_per_um;
    const double power = digit_worth(largest_mm, 1);
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor * power >= largest_mm) return factor * power;
    return 10.0 * power;
  }

  void add_point(std::string& path, char command, double angle_rad, double value_mm) const {
    const double r = base + room * value_mm / per_step_mm_;
    path += format("{}{:.1f},{:.1f}", command, middle + r * std::cos(angle_rad),
                   middle - r * std::sin(angle_rad));
  }

  double left_;
  std::string title_, body_;
  double per_step_mm_;
};

double largest_of(std::span<const double> values) {
  double out = 0.0;
  for (const double one : values) out = std::max(out, std::abs(one));
  return out;
}

std::vector<double> times(double k, std::span<const double> values) {
  std::vector<double> out(values.begin(), values.end());
  for (double& one : out) one *= k;
  return out;
}

/// A plot of the motion and, where it is separated, one of the form; side by side from `left` on,
/// or each at 0.
std::vector<std::string> plots_of(const ErrorMotion& motion, bool axial, double k, double left,
                                  double apart) {
  const PolarCurves& curves = motion.polar;
  PolarPlot plot(
      left,
      axial ? "Axial error motion"
            : format("Radial error motion along {:g}°", motion.sensitive_rad / rad_per_deg),
      std::max(largest_of(curves.motion_mm), largest_of(curves.total_mm)));
  plot.cloud(curves.total_angle_rad, curves.total_mm);
  plot.band(curves.angle_rad, curves.motion_mm, times(k, curves.u_motion_mm));
  plot.line(curves.angle_rad, curves.motion_mm, "motion", "#c55a11");
  std::vector<std::string> plots{plot.svg("synchronous " +
                                          value_text(motion.sensitive.synchronous, k) + ", total " +
                                          value_text(motion.sensitive.total, k))};
  if (curves.form_mm.empty()) return plots;
  PolarPlot form(left + apart, axial ? "Form of the face" : "Form of the part",
                 largest_of(curves.form_mm));
  form.band(curves.angle_rad, curves.form_mm, times(k, curves.u_form_mm));
  form.line(curves.angle_rad, curves.form_mm, "form", "#1f4e79");
  plots.push_back(form.svg(value_text(motion.form, k)));
  return plots;
}

std::string drawing(double width, const std::string& body) {
  return format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
             "width=\"{0:.0f}\" height=\"{1:.0f}\" font-family=\"sans-serif\" "
             "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
             width, side + 50.0) +
         body + "</svg>\n";
}

}  // namespace

std::vector<std::string> polar_svgs(const ErrorMotion& motion, bool axial, double k) {
  std::vector<std::string> out;
  for (const std::string& plot : plots_of(motion, axial, k, 0.0, 0.0))
    out.push_back(drawing(side, plot));
  return out;
}

std::string polar_svg(const SpindleResult& result) {
  double width = 0.0;
  std::string body;
  const auto add = [&](const std::optional<ErrorMotion>& motion, bool axial) {
    if (!motion) return;
    for (const std::string& plot : plots_of(*motion, axial, result.coverage_factor, width, side))
      body += plot;
    width += motion->polar.form_mm.empty() ? side : 2.0 * side;
  };
  add(result.radial, false);
  add(result.axial, true);
  return "<!-- schema: trueaxis.spindle_plot/1 -->\n" + drawing(width, body);
}

}  // namespace trueaxis
