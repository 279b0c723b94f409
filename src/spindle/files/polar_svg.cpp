// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "base/number.hpp"
#include "format/text_layout.hpp"
#include "spindle/files/spindle_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using fmt::format;

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

std::string value_of(const Estimate& estimate, double k) {
  return layout::plus_minus(estimate, k, 1.0 / mm_per_um, "µm");
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
                                          value_of(motion.sensitive.synchronous, k) + ", total " +
                                          value_of(motion.sensitive.total, k))};
  if (curves.form_mm.empty()) return plots;
  PolarPlot form(left + apart, axial ? "Form of the face" : "Form of the part",
                 largest_of(curves.form_mm));
  form.band(curves.angle_rad, curves.form_mm, times(k, curves.u_form_mm));
  form.line(curves.angle_rad, curves.form_mm, "form", "#1f4e79");
  plots.push_back(form.svg(value_of(motion.form, k)));
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
