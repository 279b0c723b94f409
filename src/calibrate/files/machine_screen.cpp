// SPDX-License-Identifier: Apache-2.0
#include "calibrate/files/machine_screen.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

using layout::um;

constexpr std::size_t most_findings = 3, most_rivals = 2, most_hidden = 8, most_plans = 5;

/// The first `most` of a list, and how many more there are.
std::string some_of(const std::vector<std::string>& all, std::size_t most) {
  const std::size_t shown = all.size() > most ? most - 1 : all.size();
  std::string text =
      fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<long>(shown), ", "));
  return all.size() > shown ? text + fmt::format(" and {} more", all.size() - shown) : text;
}

/// "X0C 25.15 ± 0.61 µm"
std::string small_estimate(const std::string& name, const Estimate& estimate, double k) {
  const bool angle = estimate.unit == "rad";
  return name + ' ' +
         layout::plus_minus(estimate, k, angle ? 1e6 : 1.0 / mm_per_um, angle ? "µrad" : "µm");
}

/// The cause, its size and its rival causes; then in words, with what follows from it.
std::string finding_screen(const MachineFinding& finding) {
  std::string text = "found  " + size_in_readings(finding);
  if (!finding.rivals.empty()) {
    std::vector<std::string> rivals;
    for (const Rival& rival : finding.rivals)
      rivals.push_back(rival.effect + " (" + layout::percent_of(rival.probability) + ")");
    text += "; not distinguishable from " + some_of(rivals, most_rivals) +
            (!finding.separate_with || finding.separate_with->plan.empty()
                 ? ", and no plan tells them apart"
                 : ", plan " + finding.separate_with->plan + " tells");
  }
  if (finding.cause.title.empty()) return text + "\n";
  return text + "\n       - " + finding.cause.title +
         (finding.cause.consequence.empty() ? "" : ": " + finding.cause.consequence) + "\n";
}

std::string read_out_screen(const AxisReadOut& one, double k) {
  const char* const unit = is_rotary(one.axis) ? "rad" : "mm";
  std::string text =
      fmt::format("axis   {}: {} readings, RMS {} -> {}, noise {}", letter_of(one.axis),
                  one.readings, small_size(one.rms_before, unit), small_size(one.rms_after, unit),
                  small_size(one.noise, unit));
  if (one.period > 0.0)
    text += fmt::format(", {} periodic in {:.6g} {}", counted(one.orders.size(), "order"),
                        is_rotary(one.axis) ? one.period / rad_per_deg : one.period,
                        is_rotary(one.axis) ? "deg" : "mm");
  text += "\n";
  if (one.reversal)
    text += "       " + small_estimate("reversal value", *one.reversal, k) +
            ": it is not in the errors file. Correct it in the control\n";
  return text;
}

/// χ² of the residuals at the stated noise, as the check of a diagnosis has it.
bool exceeds(double noise, double stated, double freedom) {
  if (!(stated > 0.0) || !(freedom > 0.0)) return false;
  const double ratio = noise / stated;
  return cdf(complement(boost::math::chi_squared(freedom), freedom * ratio * ratio)) < 1e-3;
}

/// "A 29 times the stated noise" of everything that was measured, "" where nothing exceeds it.
std::string beyond_noise(const Calibration& c) {
  std::vector<std::string> found;
  const auto state = [&](const std::string& what, double noise, double stated, double freedom) {
    if (exceeds(noise, stated, freedom))
      found.push_back(
          fmt::format("{}{} times the stated noise", what, significant(noise / stated, 2)));
  };
  state("", c.noise_mm, c.stated_noise_mm,
        static_cast<double>(c.equations) - static_cast<double>(c.unknowns));
  for (const AxisReadOut& one : c.read_outs)
    state(fmt::format("read-out of {} ", letter_of(one.axis)), one.noise, one.stated_noise,
          one.freedom);
  return found.empty() ? "" : fmt::format(", {}", fmt::join(found, ", "));
}

}  // namespace

std::string size_in_readings(const MachineFinding& finding) {
  const std::string size = small_size(finding.size, finding.cause.unit);
  return finding.effect() + ": " + size +
         (std::isfinite(finding.rms_mm) ? ", " + um(finding.rms_mm) + " in the readings" : "");
}

std::string small_size(double size, const std::string& unit) {
  return unit == "rad" ? fmt::format("{:.3g} µrad", 1e6 * size) : um(size);
}

std::string calibration_screen(const Calibration& c) {
  const std::string beyond = beyond_noise(c);
  const char* const verdict =
      beyond.empty() && components_beyond_plausible(c).empty() ? "DONE" : "UNEXPLAINED";
  std::string text;
  if (c.equations > 0)
    text = fmt::format(
        "{}: {} errors of the machine found, RMS of {} numbers {} -> {}, noise {} ({}){}\n"
        "next   trueaxis machine diagnose with the same data: names further errors\n",
        verdict, c.parameters.size(), c.equations, um(c.rms_before_mm), um(c.rms_after_mm),
        um(c.noise_mm), to_string(c.noise_basis), beyond);
  else
    text = fmt::format(
        "{}: position errors found{}\n"
        "next   trueaxis machine diagnose with the same data: names their causes\n",
        verdict, beyond);
  for (const AxisReadOut& one : c.read_outs) text += read_out_screen(one, c.coverage_factor);
  std::vector<std::string> errors, shown, open;
  for (const CalibratedParameter& one : c.parameters)
    errors.push_back(small_estimate(one.name, one.estimate, c.coverage_factor));
  if (!errors.empty())
    text += fmt::format("errors {} (U, k = {:g})\n", fmt::join(errors, ", "), c.coverage_factor);
  for (const CalibratedComponent& one : c.components)
    if (one.shown) shown.push_back(one.name + " " + small_size(one.rms.value, one.rms.unit));
  if (!shown.empty())
    text += "also   component errors, RMS: " + some_of(shown, most_hidden) +
            "; they are in the file of errors\n";
  for (const NotDetermined& one : c.not_determined) open.push_back(one.members.front());
  if (!open.empty())
    text += fmt::format("open   not determined and left as given: {}; --verbose says why\n",
                        fmt::join(open, ", "));
  return text;
}

std::string machine_findings_screen(const MachineDiagnosis& d) {
  std::string text;
  std::size_t shown = 0;
  for (const MachineFinding& finding : d.findings)
    if (shown++ < most_findings) text += finding_screen(finding);
  for (const MachineUnexplained& one : d.unexplained)
    if (shown++ < most_findings)
      text += fmt::format("found  {}, {}, without a known cause\n", one.pattern,
                          small_size(one.amplitude.value, one.amplitude.unit));
  if (shown > most_findings)
    text += fmt::format("       and {} more (--verbose)\n", shown - most_findings);
  for (const QualityCheck& check : d.checks)
    if (check.found) text += "check  " + check.text + "\n";
  std::vector<std::string> hidden;
  for (const MachineNotObservable& one : d.not_observable) hidden.push_back(one.effect);
  if (!hidden.empty())
    text += "hidden cannot be seen at these positions: " + some_of(hidden, most_hidden) + "\n";
  return text;
}

std::string machine_diagnosis_line(const MachineDiagnosis& d, const char* arrow) {
  const std::size_t found = d.findings.size(), unexplained = d.unexplained.size();
  const char* const where =
      d.of_read_outs() ? "in the read-outs" : "in addition to the location errors";
  std::string text =
      d.verdict == DiagnosisVerdict::ideal
          ? fmt::format("IDEAL: no error found {}", where)
          : fmt::format("{}: {} error{} found {}", unexplained > 0 ? "UNEXPLAINED" : "EFFECTS",
                        found + unexplained, found + unexplained == 1 ? "" : "s", where);
  if (unexplained > 0) text += fmt::format(", {} without a known cause", unexplained);
  const Explained& gain = d.gain;
  if (std::isfinite(gain.rms_before_mm) && (d.blocks > 0 || gain.rms_before_mm > 0.0))
    text += fmt::format("; RMS {} {} {}, cross-validated {} {} {}", um(gain.rms_before_mm), arrow,
                        um(gain.rms_after_mm), um(gain.held_out_before_mm.value), arrow,
                        um(gain.held_out_after_mm.value));
  return text;
}

std::string machine_diagnosis_screen(const MachineDiagnosis& d) {
  return machine_diagnosis_line(d, "->") + "\n" + next_screen(d) + machine_findings_screen(d);
}

std::string next_plan_text(const MachineDiagnosis& d, PlanBy by) {
  const MachinePlan* plan = d.next();
  if (plan == nullptr) return "nothing: no plan shows or separates any further error";
  return fmt::format("{}{} ({} readings, {:.0f} min)",
                     by == PlanBy::code ? plan->code + ", " : "Measure ", plan->what,
                     plan->visits.size(), plan->minutes);
}

std::string next_screen(const MachineDiagnosis& d) {
  return "next   " + next_plan_text(d, PlanBy::code) + "\n";
}

std::string machine_advice_screen(const MachineDiagnosis& d) {
  std::string text = "NEXT: " + next_plan_text(d, PlanBy::code) + "\n";
  std::size_t shown = 0;
  for (const MachinePlan& plan : d.plans) {
    if (shown++ == most_plans) break;
    text += fmt::format("{}{}: {:.0f} min", shown == 1 ? "plans  " : "       ", plan.code,
                        plan.minutes);
    if (!plan.separates.empty()) text += "; tells apart " + some_of(plan.separates, 4);
    text +=
        plan.shows.empty() ? "; shows nothing more\n" : "; shows " + some_of(plan.shows, 6) + "\n";
  }
  return text + machine_findings_screen(d);
}

}  // namespace trueaxis
