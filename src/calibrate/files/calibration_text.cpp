// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/number.hpp"
#include "calibrate/files/calibration_files.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

std::string unit_of(const Estimate& estimate) { return estimate.unit == "rad" ? "µrad" : "µm"; }

double small_factor(const Estimate& estimate) { return estimate.unit == "rad" ? 1e6 : 1e3; }

std::string parameter_line(const CalibratedParameter& one, double k) {
  const double factor = small_factor(one.estimate);
  const double U = k * factor * one.estimate.u;
  const int decimals = decimals_of(U, 1);
  std::string text =
      fmt::format("  {:<12}{:>12.{}f} ± {:<10.{}f} {}", one.name, factor * one.estimate.value,
                  decimals, U, decimals, unit_of(one.estimate));
  if (one.u_noise > 0.0)
    text += fmt::format("  (noise alone {:.{}f})", k * factor * one.u_noise,
                        decimals_of(k * factor * one.u_noise, 1));
  return text + '\n';
}

/// What the data show of component errors, and what u counts of those that they do not show.
std::string components_text(const Calibration& c) {
  if (c.components.empty()) return "";
  std::string shown;
  std::size_t count = 0;
  for (const CalibratedComponent& one : c.components)
    if (one.shown) {
      shown += fmt::format("{}{} {} {}", count++ == 0 ? "" : ", ", one.name,
                           significant(small_factor(one.rms) * one.rms.value, 2), unit_of(one.rms));
    }
  std::string text =
      layout::wrapped("", fmt::format("U includes {} component errors of typical size, and for "
                                      "this one {:.2g} times that size, according to these data",
                                      c.components.size(), c.size_of_components));
  if (count > 0)
    text += layout::wrapped(
        "", "The data show component errors, which the written errors include: " + shown +
                " RMS. trueaxis machine diagnose tests and names them");
  return text;
}

std::string read_out_text(const AxisReadOut& one, double k) {
  const bool rotary = is_rotary(one.axis);
  const double factor = rotary ? 1e6 : 1e3;
  const char* const unit = rotary ? "µrad" : "µm";
  std::string text = fmt::format("axis {}: {} readings, RMS {:.3g} -> {:.3g} {}, noise {:.3g} {}\n",
                                 letter_of(one.axis), one.readings, factor * one.rms_before,
                                 factor * one.rms_after, unit, factor * one.noise, unit);
  if (one.reversal)
    text += fmt::format(
        "  reversal value {} ± {} {}: it is not in the errors file. Correct it in the "
        "control\n",
        significant(factor * one.reversal->value, 3), significant(k * factor * one.reversal->u, 2),
        unit);
  if (one.period > 0.0)
    text += fmt::format("  periodic in {:.6g} {}:", rotary ? one.period / rad_per_deg : one.period,
                        rotary ? "deg" : "mm");
  for (const AxisReadOut::Order& order : one.orders)
    text += fmt::format(" {}: {:.3g}", order.order, factor * order.amplitude());
  return text + (one.period > 0.0 ? fmt::format(" {} (order: amplitude)\n", unit) : "");
}

}  // namespace

std::string calibration_text(const Calibration& c) {
  std::string text;
  for (const AxisReadOut& one : c.read_outs) text += read_out_text(one, c.coverage_factor);
  if (c.equations > 0)
    text += fmt::format("{} numbers, {} unknowns: RMS {} -> {}, noise {} ({})\n", c.equations,
                        c.unknowns, layout::um(c.rms_before_mm), layout::um(c.rms_after_mm),
                        layout::um(c.noise_mm), to_string(c.noise_basis));
  if (!c.parameters.empty()) text += fmt::format("parameters ± U (k = {:g})\n", c.coverage_factor);
  for (const CalibratedParameter& one : c.parameters)
    text += parameter_line(one, c.coverage_factor);
  text += components_text(c);
  if (!c.not_determined.empty()) text += "not determined\n";
  for (const NotDetermined& one : c.not_determined) text += layout::wrapped("  ", one.why) + "\n";
  if (!c.gauge.empty()) text += layout::wrapped("", c.gauge) + "\n";
  return text;
}

}  // namespace trueaxis
