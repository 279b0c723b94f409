// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "base/number.hpp"
#include "fit/files/fit_files.hpp"
#include "fit/probe_height.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// " (from LOW to HIGH)" where the sides of an interval differ by more than the last digit of U.
std::string ends(const Estimate& e, double U) {
  if (!e.interval) return "";
  const auto [low, high] = *e.interval;
  const int decimals = decimals_of(U, 0);
  const double last_digit = digit_worth(U, 2);
  if (std::abs((high - e.value) - (e.value - low)) <= last_digit) return "";
  return fmt::format(" (from {:.{}f} to {:.{}f})", low, decimals, high, decimals);
}

void append_parameters(std::string& text, const std::vector<FitParameter>& parameters, double k) {
  for (const FitParameter& p : parameters) {
    const Estimate e = at_edge(p.estimate);
    const double U = e.expanded(k);
    if (!e.determined()) {
      put(text, "  {:<16} {:>16}  {}\n", p.name, "-", e.why_not);
    } else if (!std::isfinite(U)) {
      put(text, "  {:<16} {:16.6f}  {:<3}  ({})\n", p.name, e.value, e.unit, e.why_not);
    } else {
      const int decimals = decimals_of(U, 0);
      put(text, "  {:<16} {:16.{}f} ± {:<10} {}{}\n", p.name, e.value, decimals,
          fmt::format("{:.{}f}", U, decimals), e.unit, ends(e, U));
    }
  }
}

/// "set-up 2  rear: x0 0.3012 ± 0.0004 mm, …".
void append_set_up(std::string& text, const SetUpFit& one, double k) {
  put(text, "  {:<16}", "set-up " + std::to_string(one.set_up.number));
  text += one.side == Root::rear ? " rear: " : " front:";
  for (const FitParameter& p : one.parameters) {
    const Estimate e = at_edge(p.estimate);
    const double U = e.expanded(k);
    text += &p == one.parameters.data() ? " " : ", ";
    if (!e.determined() || !std::isfinite(U)) {
      put(text, "{} -", p.name);
    } else {
      const int decimals = decimals_of(U, 0);
      put(text, "{} {:.{}f} ± {:.{}f}{}{}", p.name, e.value, decimals, U, decimals,
          e.unit == "1" ? "" : " " + e.unit, ends(e, U));
    }
  }
  text += "\n";
}

}  // namespace

std::string fit_text(const FitResult& result) {
  std::string text;
  put(text, "{} of {}: {}, {} readings, {} rejected, loss {}\n", to_string(result.surface),
      result.source, to_string(result.status), result.points, result.rejected.size(),
      to_string(result.loss));
  if (!result.message.empty()) text += "  " + result.message + "\n";
  put(text, "  parameters ± U (k = {:.3g})\n", result.coverage_factor);
  append_parameters(text, result.parameters, result.coverage_factor);
  append_parameters(text, result.derived, result.coverage_factor);
  if (holds_on_centre_height(result)) text += "  the radius is that for a probe on centre height\n";
  if (result.set_ups.size() > 1) {
    for (const SetUpFit& one : result.set_ups) append_set_up(text, one, result.coverage_factor);
  }
  put(text, "  RMS {:.4g} µm, σ {:.4g} µm (from {})\n", result.rms_mm / mm_per_um,
      result.sigma_mm / mm_per_um, to_string(result.sigma_source));
  for (const std::string& note : result.input_notes) text += "  input: " + note + "\n";
  for (const std::string& note : result.notes) text += "  note: " + note + "\n";
  for (std::size_t i = 0; i < result.rejected.size() && i < 10; ++i) {
    put(text, "  rejected: row {}, {}\n", result.rejected[i].row, result.rejected[i].why);
  }
  if (result.rejected.size() > 10)
    put(text, "  rejected: {} more, all of them in the JSON\n", result.rejected.size() - 10);
  return text;
}

}  // namespace trueaxis
