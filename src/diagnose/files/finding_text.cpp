// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/finding_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "format/text_layout.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace layout;

/// Lengths whose typical size is below half a millimetre are shown in µm.
bool is_small_length(const Effect& effect, const FitParameter& parameter) {
  if (parameter.estimate.unit != "mm") return false;
  for (const EffectParameter& p : effect.parameters) {
    if (p.name == parameter.name && p.high > 0.0) return p.high < 0.5;
  }
  return std::abs(parameter.estimate.value) < 0.5;
}

std::string parameter_text(const Effect& effect, const FitParameter& p, double k) {
  const Estimate& e = p.estimate;
  std::string name = p.name;
  for (std::size_t i = 0; i + 1 < name.size(); ++i) {  // amplitude_2 keeps its number
    if (name[i] == '_' && (name[i + 1] < '0' || name[i + 1] > '9')) name[i] = ' ';
  }
  const bool exact = e.determined() && e.u == 0.0;
  if (exact) return name + fmt::format(" {:.6g}", e.value) + (e.unit == "1" ? "" : " " + e.unit);
  const bool small = is_small_length(effect, p);
  return name + " " + plus_minus(e, k, small ? 1.0 / mm_per_um : 1.0, small ? "µm" : e.unit);
}

}  // namespace

std::string harmonic_text(const Pattern& p) {
  return p.kind == Pattern::Kind::bump ? "local form" : fmt::format("{:.4g} UPR", p.order);
}

std::string dependence_text(const Pattern& p) {
  const char* along = p.in_time ? "time" : "Z";
  if (p.kind == Pattern::Kind::bump) {
    const std::string around =
        fmt::format("at {:.1f}° (± {:.1f}°)", p.angle_rad / rad_per_deg, p.width_rad / rad_per_deg);
    if (!(p.length_mm > 0.0)) return around;
    return around + fmt::format(", Z {:.2f} mm (± {:.2f} mm)", p.position_mm, p.length_mm);
  }
  if (p.kind == Pattern::Kind::line) {
    return p.in_time ? fmt::format("turning with {:.4g} Hz", p.frequency)
                     : fmt::format("turning along Z, {:.4g} per mm", p.frequency);
  }
  if (p.degree == 0) return fmt::format("constant along {}", along);
  return p.degree == 1 ? fmt::format("linear in {}", along)
                       : fmt::format("P{} in {}", p.degree, along);
}

std::string finding_parameters(const Finding& finding, double coverage_factor) {
  std::string text;
  for (const bool order : {true, false}) {  // the order first
    for (const FitParameter& p : finding.parameters) {
      if ((p.name == "order") != order) continue;
      if (!text.empty()) text += ", ";
      text += parameter_text(*finding.term.effect, p, coverage_factor);
    }
  }
  if (!finding.alias.empty()) text += "; the sampling cannot tell it from " + finding.alias;
  return text;
}

std::string finding_class(const Finding& finding) {
  if (finding.rivals.empty()) return finding.effect();
  const auto member = [](const std::string& id, double p) {
    return id + (std::isfinite(p) ? " (" + probability(p) + ")" : "");
  };
  std::string text = member(finding.effect(), finding.probability);
  for (const Rival& rival : finding.rivals)
    text += " or " + member(rival.effect, rival.probability);
  return text + ": the data cannot tell";
}

std::string finding_axis_bias(const Finding& finding, double coverage_factor, bool face) {
  constexpr double nothing_mm = 1e-6;
  const bool nothing =
      finding.axis_shift.value + coverage_factor * finding.axis_shift.u < nothing_mm;
  const std::string shift =
      nothing ? "less than 0.001 µm"
              : plus_minus(finding.axis_shift, coverage_factor, 1.0 / mm_per_um, "µm");
  if (face)
    return "left out it tilts the face by " + shift + " at its outer end" +
           (finding.cosmetic ? ": cosmetic for the run-out" : "");
  return "left out it moves the axis by " + shift +
         (finding.cosmetic ? ": cosmetic for coaxiality" : "");
}

std::string separating_text(const Separating& s) {
  if (s.plan.empty()) return "none of the plans: " + s.why_not;
  std::string text = s.plan + (s.what.empty() ? "" : ", " + s.what);
  text += ": right name " + probability(s.power_before) + " → " + probability(s.power);
  text += fmt::format(", {:.3g} min", s.minutes);
  for (const Separating::Other& o : s.others)
    text +=
        "; or " + o.plan + " (→ " + probability(o.power) + fmt::format(", {:.3g} min)", o.minutes);
  return text;
}

std::string axis_bias_per_unit_text(const Estimate& axis_bias) {
  if (!axis_bias.determined()) return axis_bias.why_not.empty() ? "not known" : axis_bias.why_not;
  if (axis_bias.unit.rfind("mm/", 0) != 0)
    return fmt::format("{:.2g} ", axis_bias.value) + axis_bias.unit;
  std::string per = axis_bias.unit.substr(3);
  std::erase_if(per, [](char c) { return c == '(' || c == ')'; });
  if (per == "mm") return fmt::format("{:.2g} µm per µm", axis_bias.value);
  return fmt::format("{:.3g} µm per ", axis_bias.value / mm_per_um) + (per == "1" ? "unit" : per);
}

}  // namespace trueaxis
