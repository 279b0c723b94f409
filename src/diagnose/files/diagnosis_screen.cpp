// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/diagnosis_screen.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/never.hpp"
#include "base/number.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "diagnose/files/seen.hpp"
#include "effect/short_name.hpp"
#include "fit/files/fit_files.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;
namespace {

constexpr std::size_t most_findings = 3, most_causes = 2;

std::string line(const std::string& head, const std::string& text) { return head + text + "\n"; }

std::string verdict_line(const Diagnosis& d) {
  const auto found = d.findings.size(), unexplained = d.unexplained.size();
  const std::string rms =
      fmt::format("residuals {} RMS, noise {}", um(rms_shown_mm(d)), um(d.noise.sigma_mm));
  const std::string known = axis_accuracy(d.extended);
  const std::string accuracy = known.empty() ? "" : ", " + known;
  if (d.verdict == DiagnosisVerdict::ideal)
    return (d.extended.axis_known() ? "IDEAL: " : "NOT KNOWN: ") + ideal_words(d) + accuracy +
           "; " + rms;
  std::string text = d.verdict == DiagnosisVerdict::effects ? "EFFECTS: " : "UNEXPLAINED: ";
  text += fmt::format("{} deviation{} from an ideal {}", found + unexplained,
                      found + unexplained == 1 ? "" : "s", to_string(d.baseline.surface));
  if (unexplained > 0) text += fmt::format(", {} without a known cause", unexplained);
  return text + accuracy + "; " + rms;
}

}  // namespace

std::string ideal_words(const Diagnosis& d) {
  const std::size_t all = d.baseline.points, excluded = d.noise.masked.size();
  return std::string("no deviation from an ideal ") + to_string(d.baseline.surface) + " detected" +
         (excluded > 0 ? fmt::format(" in {} of {} readings", all - excluded, all) : "");
}

double rms_shown_mm(const Diagnosis& d) {
  return d.verdict != DiagnosisVerdict::ideal ? d.gain.rms_after_mm
         : d.noise.masked.empty()             ? d.baseline.rms_mm
                                              : d.extended.rms_mm;
}

std::string findings_screen(const Diagnosis& d, std::size_t most) {
  const double k = d.baseline.coverage_factor;
  std::string text;
  std::size_t shown = 0;
  for (const Finding& finding : d.findings) {
    if (shown++ == most) break;
    text += line(
        "found  ",
        seen_text(finding, k) +
            (finding.cosmetic
                 ? ""
                 : "; " + finding_axis_bias(finding, k, d.baseline.surface == SurfaceKind::plane)));
    for (const std::string& cause : cause_lines(d, finding, most_causes))
      text += line("       - ", cause);
  }
  for (const Unexplained& pattern : d.unexplained) {
    if (shown++ >= most) break;
    text += line("found  ", seen_text(pattern, k));
  }
  const std::size_t all = d.findings.size() + d.unexplained.size();
  if (all > most) text += fmt::format("       and {} more (--verbose)\n", all - most);
  return text;
}

std::string unseen_screen(const Diagnosis& d) {
  constexpr std::size_t most = 2;  // one line of a terminal
  const FitResult& fit = d.extended;
  if (!fit.axis_known() || fit.surface == SurfaceKind::plane) return "";
  const double U_mm = fit.coverage_factor * std::min(fit.axis.u_at(fit.position_min_mm),
                                                     fit.axis.u_at(fit.position_max_mm));
  std::vector<std::string> sizes;
  for (const NotObservable& n : d.not_observable) {
    const double per_unit = n.axis_bias_per_unit.value, size = U_mm / per_unit;
    const Effect* effect = d.entry(n.effect);
    if (!is_never(n.detectable, n.detectable_unit) || !std::isfinite(per_unit) ||
        is_never(size, n.detectable_unit) || (effect && (effect->same_in_cut || effect->stated)) ||
        sizes.size() == most)
      continue;
    const bool milli = n.detectable_unit == "s" && size < 1.0;
    const Estimate shown = at_edge({size, 0.0, n.detectable_unit, ""});
    const double digit = digit_worth(size, 2);
    sizes.push_back((n.detectable_unit == "mm" ? um(digit * std::round(size / digit))
                     : milli                   ? significant(1e3 * size, 2) + " ms"
                     : shown.unit == "1"       ? significant(size, 2)
                                               : significant(shown.value, 2) + " " + shown.unit) +
                    " of " + (effect ? plain_name(*effect) : n.effect));
  }
  return sizes.empty()
             ? ""
             : line("hidden ", fmt::format("{} moves the axis by U", fmt::join(sizes, " or ")));
}

std::string excluded_screen(const Diagnosis& d) {
  std::string text;
  for (const DataCheck check : {DataCheck::outliers, DataCheck::interruption})
    for (const QualityCheck& one : d.checks)
      if (one.found && one.effect == entry_of(check).id) text += line("check  ", one.text);
  return text;
}

std::string diagnosis_screen(const Diagnosis& d, const std::string& form) {
  if (d.baseline.status != FitStatus::converged) return line("", diagnosis_line(d));
  std::string text =
      line("", verdict_line(d)) + tap_screen(d.extended, to_string(d.extended.surface));
  for (const std::string& note : d.baseline.input_notes) text += line("input  ", note);
  const bool tilt_alone = d.extended.surface == SurfaceKind::plane && d.extended.axis_known();
  text += findings_screen(d, most_findings) + (tilt_alone ? "" : form) + axis_screen(d.extended) +
          unseen_screen(d);
  for (const QualityCheck& check : d.checks)
    if (check.found) text += line("check  ", check.text + " [" + check.effect + "]");
  const bool sure = std::isfinite(d.extended.axis.u_at(d.extended.position_max_mm));
  if (d.verdict == DiagnosisVerdict::ideal)
    text += !d.extended.axis_known() ? ""
            : sure                   ? "next   nothing: the axis can be used\n"
                   : "next   probe more: these readings do not give an uncertainty of the axis\n";
  else if (!d.next.plan.empty())
    text +=
        line("next   ",
             fmt::format("{}: {:.0f} min, then the right cause is named with a probability of {}",
                         d.next.what, std::ceil(d.next.minutes), probability(d.next.power_after)));
  return text + limit_screen(d) + (tilt_alone ? form : "");
}

}  // namespace trueaxis
