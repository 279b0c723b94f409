// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "format/text_layout.hpp"
#include "spindle/files/spindle_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using fmt::format;
using layout::padded;
using layout::wrapped;

/// "5, 10 to 12".
std::string numbers(const std::vector<int>& orders) {
  std::string text;
  for (std::size_t i = 0; i < orders.size();) {
    std::size_t end = i;
    while (end + 1 < orders.size() && orders[end + 1] == orders[end] + 1) ++end;
    text += format("{}{}", text.empty() ? "" : ", ", orders[i]);
    if (end > i) text += format("{}{}", end == i + 1 ? ", " : " to ", orders[end]);
    i = end + 1;
  }
  return text;
}

/// Suppressed orders, those with the same reason together; the numbers of a condition are a range.
std::string suppressed_text(const ErrorMotion& motion) {
  std::vector<int> singular, weak;
  double least = 1e300, largest = 0.0;
  for (const SeparatedOrder& one : motion.orders) {
    if (one.suppressed.empty()) continue;
    if (!std::isfinite(one.condition)) {
      singular.push_back(one.order);
      continue;
    }
    weak.push_back(one.order);
    least = std::min(least, one.condition);
    largest = std::max(largest, one.condition);
  }
  if (singular.empty() && weak.empty()) return "  suppressed     no order\n";
  std::string text;
  if (!singular.empty())
    text += wrapped("  suppressed     ", numbers(singular) +
                                             ": form and motion are read as one (condition number "
                                             "infinite)");
  if (!weak.empty())
    text += wrapped(
        "  suppressed     ",
        numbers(weak) +
            (weak.size() == 1 ? format(": condition number {:.0f}", largest)
                              : format(": condition numbers {:.0f} to {:.0f}", least, largest)) +
            ", too large for the noise (--json says the limits)");
  return text;
}

std::string heading(const ErrorMotion& motion, bool axial) {
  const auto least = std::ranges::min(motion.runs, {}, &SpindleRun::turns);
  std::size_t sensors = 0;
  for (const SpindleRun& run : motion.runs) sensors = std::max(sensors, run.sensors);
  const std::string along =
      axial ? "Axial error motion"
            : format("Radial error motion along {:g}°", motion.sensitive_rad / rad_per_deg);
  return format("{}: {} sensor{}, {} set-up{}, {:.4g} turns of {:.4g} readings, orders {} to {}\n",
                along, sensors, sensors == 1 ? "" : "s", motion.runs.size(),
                motion.runs.size() == 1 ? "" : "s", least.turns, least.readings_per_turn,
                motion.orders.front().order, motion.orders.back().order);
}

std::string motion_text(const ErrorMotion& motion, bool axial, double k) {
  std::string text = heading(motion, axial);
  if (axial && motion.fundamental.determined()) {
    text += "  fundamental    " + value_text(motion.fundamental, k) + '\n';
    text += "  residual sync. " + value_text(motion.residual, k) + '\n';
  }
  text += "  synchronous    " + padded(value_text(motion.sensitive.synchronous, k), 24);
  if (motion.across_seen) text += "  across  " + value_text(motion.across.synchronous, k);
  text += "\n  asynchronous   " + padded(value_text(motion.sensitive.asynchronous, k), 24);
  if (motion.across_seen) text += "  across  " + value_text(motion.across.asynchronous, k);
  text += "\n  total          " + padded(value_text(motion.sensitive.total, k), 24);
  if (motion.across_seen) text += "  across  " + value_text(motion.across.total, k);
  text += '\n';
  if (motion.form_seen())
    text += (axial ? "  form of face   " : "  roundness      ") + value_text(motion.form, k) + '\n';
  return text + suppressed_text(motion);
}

std::string cell(const SpindleHarmonic& one, double k) { return padded(harmonic_text(one, k), 34); }

std::string table(const ErrorMotion& motion, double k) {
  const bool form = motion.form_seen();
  std::string text = "\n  order  condition  ";
  if (form) text += padded("form: amplitude ± U, phase", 34);
  text += padded("motion", 34) + (motion.across_seen ? "across" : "") + '\n';
  for (const SeparatedOrder& one : motion.orders) {
    const std::string condition =
        std::isfinite(one.condition) ? format("{:.1f}", one.condition) : "infinite";
    std::string row = "  " + padded(std::to_string(one.order), 7) + padded(condition, 11);
    if (form) row += cell(one.form, k);
    row += cell(one.sensitive, k);
    if (motion.across_seen) row += cell(one.across, k);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + '\n';
  }
  return text;
}

std::string layout_text(std::span<const double> angles_rad, int order_min, int order_max,
                        double largest_condition) {
  const auto conditions = separation_conditions(angles_rad, order_min, order_max);
  std::vector<int> suppressed;
  double worst = 0.0;
  int worst_order = order_min;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    const int order = order_min + static_cast<int>(i);
    if (conditions[i] > largest_condition) {
      suppressed.push_back(order);
    } else if (conditions[i] > worst) {
      worst = conditions[i];
      worst_order = order;
    }
  }
  std::string angles;
  for (const double angle : angles_rad)
    angles += (angles.empty() ? "" : ", ") + format("{:.5g}", angle / rad_per_deg);
  std::string text = angles + " deg: ";
  text += worst > 0.0 ? format("condition number at most {:.1f} (order {})", worst, worst_order)
                      : std::string("no order is separated");
  text += suppressed.empty()
              ? format(", no order of {} to {} suppressed", order_min, order_max)
              : format("; suppressed (condition number above {:g}): ", largest_condition) +
                    numbers(suppressed);
  return text;
}

}  // namespace

std::string value_text(const Estimate& estimate, double k) {
  return layout::plus_minus(estimate, k, 1.0 / mm_per_um, "µm") +
         (estimate.interval ? " (95 %)" : "");
}

std::string harmonic_text(const SpindleHarmonic& one, double k) {
  if (!one.determined()) return "suppressed";
  return format("{:.4g} ± {:.2g} nm, {:.0f}°", one.amplitude_mm() * 1e6, k * one.u_mm * 1e6,
                one.phase_rad() / rad_per_deg);
}

std::string spindle_text(const SpindleResult& result, bool verbose) {
  const double k = result.coverage_factor;
  std::string text;
  if (result.radial) text += motion_text(*result.radial, false, k);
  if (result.axial) text += motion_text(*result.axial, true, k);
  for (const std::string& note : result.notes) text += wrapped("note: ", note);
  if (verbose && result.radial) text += table(*result.radial, k);
  if (verbose && result.axial) text += table(*result.axial, k);
  return text;
}

std::string spindle_advice_text(std::span<const double> proposed_rad,
                                std::span<const double> given_rad, int order_min, int order_max,
                                double largest_condition) {
  std::string text =
      wrapped("proposed  ", layout_text(proposed_rad, order_min, order_max, largest_condition));
  if (!given_rad.empty())
    text += wrapped("given     ", layout_text(given_rad, order_min, order_max, largest_condition));
  return text;
}

}  // namespace trueaxis
