// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "diagnose/files/axes_text.hpp"
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
  const Estimate e = at_edge(p.estimate);
  std::string name = p.name;
  for (std::size_t i = 0; i + 1 < name.size(); ++i) {  // amplitude_2 keeps its number
    if (name[i] == '_' && (name[i + 1] < '0' || name[i + 1] > '9')) name[i] = ' ';
  }
  const bool exact = e.determined() && e.u == 0.0;
  if (exact) return name + fmt::format(" {:.6g}", e.value) + (e.unit == "1" ? "" : " " + e.unit);
  const bool small = is_small_length(effect, p);
  return name + " " + plus_minus(e, k, small ? 1.0 / mm_per_um : 1.0, small ? "µm" : e.unit);
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string held_out(const Gain& gain) {
  const double before = gain.held_out_before_mm.value, after = gain.held_out_after_mm.value;
  const Interval& ratio = gain.held_out_ratio;
  std::string text;
  if (before > 0.0 && std::isfinite(after)) {
    text +=
        fmt::format("; cross-validated RMS {:.3g} → {:.3g} µm (ratio {:.2f}, 95 % {:.2f}-{:.2f})",
                    before / mm_per_um, after / mm_per_um, ratio.value, ratio.low, ratio.high);
  } else {
    text += fmt::format("; RMS {:.3g} → {:.3g} µm", gain.rms_before_mm / mm_per_um,
                        gain.rms_after_mm / mm_per_um);
  }
  if (gain.noise_floor_mm > 0.0) text += ", noise floor " + um(gain.noise_floor_mm);
  return text;
}

std::string origin(const Diagnosis& d) {
  std::string text = std::string(to_string(d.baseline.surface)) + " of " + d.baseline.source +
                     ": " + std::to_string(d.baseline.points) + " readings";
  if (d.hypotheses > 0) {
    text += fmt::format(", {} hypotheses tried, false alarm {:.3g} % over all of them",
                        d.hypotheses, 100.0 * d.false_alarm);
  }
  text = wrapped("", text);
  for (const std::string& note : d.baseline.input_notes) text += wrapped("input: ", note);
  return text;
}

/// What a slip does to the meaning of the axis; empty for any other cause.
std::string axis_note(const Finding& finding) {
  return is_step(finding.term.effect->term) ? "that of the part after the slip" : "";
}

bool is_face(const Diagnosis& d) { return d.baseline.surface == SurfaceKind::plane; }

std::string finding_block(const Finding& finding, std::size_t number, double k, bool face) {
  std::string text = "\n";
  text += wrapped(fmt::format("{:2}  ", number),
                  finding.effect() + "  " + finding_parameters(finding, k));
  if (!finding.rivals.empty()) text += wrapped("    cause    ", finding_class(finding));
  text += wrapped("    bias     ", finding_axis_bias(finding, k, face) +
                                       "; RMS of its part of the readings " + um(finding.rms_mm));
  const std::string axis = axis_note(finding);
  if (!axis.empty()) text += wrapped("    axis     ", axis);
  text += wrapped("    sure     ", "family-wise p " + probability(finding.p_value));
  if (finding.separate_with)
    text += wrapped("    to tell  ", separating_text(*finding.separate_with));
  return text;
}

std::string unexplained_block(const Unexplained& u, double k) {
  return wrapped(" ?  ", harmonic_text(u.term.pattern) + ", " + dependence_text(u.term.pattern) +
                             ", amplitude " + plus_minus(u.amplitude, k, 1.0 / mm_per_um, "µm") +
                             ": no cause of the catalogue explains it; it remains in the model to "
                             "protect the axis; family-wise p " +
                             probability(u.p_value));
}

std::string gain_block(const Diagnosis& d) {
  const Gain& gain = d.gain;
  const double k = d.baseline.coverage_factor, um_per_mm = 1.0 / mm_per_um;
  if (d.findings.empty() && d.unexplained.empty()) return "";
  std::string text = "\nGain\n";
  const bool face = is_face(d);
  text += wrapped("  axis        ", (face ? "tilted, at the outer end by " : "shifted by ") +
                                        plus_minus(gain.axis_shift, k, um_per_mm, "µm"));
  const std::string after = plus_minus(gain.coaxiality_after, k, um_per_mm, "µm");
  const char* expected = face ? "expected at the outer end, cut square to this axis alone: "
                              : "expected over the probed length, cut about this axis alone: ";
  text += wrapped(
      face ? "  run-out     " : "  coaxiality  ",
      gain.coaxiality_after.determined()
          ? expected + plus_minus(gain.coaxiality_before, k, um_per_mm, "µm") + " → " + after
          : after);
  if (!gain.blocks.empty()) text += wrapped("  cross-val.  ", gain.blocks);
  return text;
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
  constexpr double surprising = 0.02, unusual = 1.5;
  if (finding.rivals.empty()) return finding.effect();
  const auto member = [](const std::string& id, double p) {
    return id + (std::isfinite(p) ? " (" + probability(p) + ")" : "");
  };
  std::string text = member(finding.effect(), finding.probability);
  for (const Rival& rival : finding.rivals) {
    text += " or " + member(rival.effect, rival.probability);
    if (rival.probability < surprising && rival.times_usual > unusual)
      text += fmt::format(", then {:.2g} times as large as usual", rival.times_usual);
    if (rival.probability < surprising && rival.times_usual > 0.0 &&
        rival.times_usual < 1.0 / unusual)
      text += fmt::format(", then {:.2g} of the least that is usual", rival.times_usual);
  }
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
    return "if not modelled, it tilts the face by " + shift + " at its outer end" +
           (finding.cosmetic ? ": cosmetic for the run-out" : "");
  return "if not modelled, it moves the axis by " + shift +
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

std::string axis_bias_per_unit_text(const Estimate& inside) {
  const Estimate axis_bias = at_edge(inside);
  if (!axis_bias.determined()) return axis_bias.why_not.empty() ? "not known" : axis_bias.why_not;
  if (axis_bias.unit.rfind("mm/", 0) != 0)
    return fmt::format("{:.2g} ", axis_bias.value) + axis_bias.unit;
  std::string per = axis_bias.unit.substr(3);
  std::erase_if(per, [](char c) { return c == '(' || c == ')'; });
  if (per == "mm") return fmt::format("{:.2g} µm per µm", axis_bias.value);
  return fmt::format("{:.3g} µm per ", axis_bias.value / mm_per_um) + (per == "1" ? "unit" : per);
}

std::string diagnosis_line(const Diagnosis& d) {
  if (d.baseline.status != FitStatus::converged)
    return std::string("NOT DIAGNOSED: ") + to_string(d.baseline.status) + ": " +
           d.baseline.message;
  const std::string causes = counted(d.findings.size(), "cause", "causes") + " found";
  std::string text;
  switch (d.verdict) {
    case DiagnosisVerdict::ideal:
      return "IDEAL: no deviation from the ideal " + std::string(to_string(d.baseline.surface)) +
             " was found; RMS " + um(d.baseline.rms_mm) + ", noise of a reading " +
             um(d.noise.sigma_mm);
    case DiagnosisVerdict::effects:
      text = "EFFECTS: " + causes;
      break;
    case DiagnosisVerdict::unexplained:
      text = "UNEXPLAINED: " + counted(d.unexplained.size(), "pattern", "patterns") +
             " without a catalogued cause" + (d.findings.empty() ? "" : ", " + causes);
      break;
  }
  return text + held_out(d.gain);
}

std::string findings_text(const Diagnosis& d) {
  const double k = d.baseline.coverage_factor;
  std::string text = wrapped("diagnosis   ", diagnosis_line(d));
  for (const Finding& f : d.findings) {
    text += wrapped("  ", f.effect() + "  " + finding_parameters(f, k) + "; " +
                              finding_axis_bias(f, k, is_face(d)));
    if (!f.rivals.empty()) text += wrapped("    ", finding_class(f));
    const std::string axis = axis_note(f);
    if (!axis.empty()) text += wrapped("    ", "the axis is " + axis);
  }
  for (const Unexplained& u : d.unexplained) {
    text += wrapped("  ", "unexplained: " + harmonic_text(u.term.pattern) + ", " +
                              dependence_text(u.term.pattern) + ", amplitude " +
                              plus_minus(u.amplitude, k, 1.0 / mm_per_um, "µm"));
  }
  return text + axes_text(d, "axis");
}

std::string diagnosis_text(const Diagnosis& d) {
  const double k = d.baseline.coverage_factor;
  std::string text = wrapped("", diagnosis_line(d)) + "\n" + origin(d);
  if (d.baseline.status != FitStatus::converged) return text;
  if (d.extended.status != FitStatus::converged) {
    text += wrapped("the final fit: ",
                    std::string(to_string(d.extended.status)) + ": " + d.extended.message);
  }
  if (!d.findings.empty()) {
    text += fmt::format("\nCauses, the most harmful first; ± U (k = {:.3g})\n", k);
    for (std::size_t i = 0; i < d.findings.size(); ++i)
      text += finding_block(d.findings[i], i + 1, k, is_face(d));
  }
  if (!d.unexplained.empty()) text += "\nUnexplained\n";
  for (const Unexplained& u : d.unexplained) text += unexplained_block(u, k);
  return text + axes_text(d, "\nAxis") + gain_block(d) + not_observable_text(d) +
         noise_text(d.noise) + checks_text(d.checks) + remarks_text(d.remarks) + next_text(d.next);
}

}  // namespace trueaxis
