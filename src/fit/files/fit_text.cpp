// SPDX-License-Identifier: Apache-2.0
#include "fit/files/fit_text.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...) {
  char line[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

void append_parameters(std::string& text, const std::vector<FitParameter>& parameters, double k) {
  for (const FitParameter& p : parameters) {
    const Estimate& e = p.estimate;
    const double U = k * e.u;
    if (!e.determined()) {
      append(text, "  %-16s %16s  %s\n", p.name.c_str(), "-", e.why_not.c_str());
    } else if (!std::isfinite(U)) {
      append(text, "  %-16s %16.6f  %-3s  (%s)\n", p.name.c_str(), e.value, e.unit.c_str(),
             e.why_not.c_str());
    } else {
      append(text, "  %-16s %16.*f ± %-10.2g %s\n", p.name.c_str(), decimals_of(U), e.value, U,
             e.unit.c_str());
    }
  }
}

/// "set-up 2  rear: x0 0.3012 ± 0.0004 mm, …".
void append_set_up(std::string& text, const SetUpFit& one, double k) {
  append(text, "  %-16s", ("set-up " + std::to_string(one.set_up.number)).c_str());
  text += one.side == Root::rear ? " rear: " : " front:";
  for (const FitParameter& p : one.parameters) {
    const Estimate& e = p.estimate;
    text += &p == one.parameters.data() ? " " : ", ";
    if (!e.determined() || !std::isfinite(k * e.u)) {
      append(text, "%s -", p.name.c_str());
    } else {
      append(text, "%s %.*f ± %.2g%s%s", p.name.c_str(), decimals_of(k * e.u), e.value, k * e.u,
             e.unit == "1" ? "" : " ", e.unit == "1" ? "" : e.unit.c_str());
    }
  }
  text += "\n";
}

}  // namespace

std::string fit_text(const FitResult& result) {
  std::string text;
  append(text, "%s of %s: %s, %zu readings, %zu rejected, loss %s\n", result.surface.c_str(),
         result.source.c_str(), to_string(result.status), result.points, result.rejected.size(),
         to_string(result.loss));
  if (!result.message.empty()) text += "  " + result.message + "\n";
  append(text, "  parameters ± U (k = %.3g)\n", result.coverage_factor);
  append_parameters(text, result.parameters, result.coverage_factor);
  append_parameters(text, result.derived, result.coverage_factor);
  if (result.set_ups.size() > 1) {
    for (const SetUpFit& one : result.set_ups) append_set_up(text, one, result.coverage_factor);
  }
  append(text, "  RMS %.4g µm, σ %.4g µm (from %s)\n", result.rms_mm / mm_per_um,
         result.sigma_mm / mm_per_um, result.sigma_source.c_str());
  for (const std::string& note : result.notes) text += "  note: " + note + "\n";
  for (std::size_t i = 0; i < result.rejected.size() && i < 10; ++i) {
    append(text, "  rejected: row %zu, %s\n", result.rejected[i].row,
           result.rejected[i].why.c_str());
  }
  if (result.rejected.size() > 10)
    append(text, "  rejected: %zu more, all of them in the JSON\n", result.rejected.size() - 10);
  return text;
}

}  // namespace trueaxis
