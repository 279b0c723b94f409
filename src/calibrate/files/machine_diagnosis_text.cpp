// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "base/text.hpp"
#include "calibrate/files/machine_diagnosis_files.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "format/text_layout.hpp"

namespace trueaxis {
namespace {

std::string finding_text(const MachineFinding& finding) {
  std::string text = fmt::format("{} (p {:.2g})\n", size_in_readings(finding), finding.p_value);
  text += layout::wrapped("  ", finding.cause.consequence);
  if (finding.rivals.empty()) return text;
  const auto with_probability = [](const Rival& rival) {
    return rival.effect + " (" + layout::percent_of(rival.probability) + ")";
  };
  text += layout::wrapped("  not told from ", word_list(finding.rivals, ", ", with_probability));
  const std::string plan = finding.separate_with ? finding.separate_with->plan : "";
  text += plan.empty() ? "  none of the plans tells them apart\n"
                       : "  plan " + plan + " tells them apart\n";
  return text;
}

/// Effects that share their reason and their plans, in one line.
std::string not_observable_text(const MachineDiagnosis& d) {
  std::map<std::pair<std::string, std::vector<std::string>>, std::vector<std::string>> alike;
  for (const MachineNotObservable& one : d.not_observable)
    alike[{one.why, one.plans()}].push_back(one.effect);
  std::string text;
  for (const auto& [why, effects] : alike)
    text += layout::wrapped(
        "  ",
        fmt::format("{}: {}; {}", fmt::join(effects, " "), why.first,
                    why.second.empty() ? "none of the plans shows them"
                                       : fmt::format("shown by {}", fmt::join(why.second, ", "))));
  return text;
}

}  // namespace

std::string machine_diagnosis_text(const MachineDiagnosis& d) {
  const bool alone = d.of_read_outs();
  std::string text =
      d.verdict == DiagnosisVerdict::ideal
          ? alone ? "no errors were found in the read-outs\n"
                  : "no errors other than the location errors were found\n"
          : std::string(alone ? "in the read-outs" : "in addition to the location errors") +
                (d.verdict == DiagnosisVerdict::effects ? ":\n" : ", partly unexplained:\n");
  for (const MachineFinding& finding : d.findings) text += finding_text(finding);
  for (const MachineUnexplained& one : d.unexplained)
    text += fmt::format("unexplained: {}, {} (p {:.2g})\n", one.pattern,
                        small_size(one.amplitude.value, one.amplitude.unit), one.p_value);
  for (const std::string& remark : d.remarks) text += layout::wrapped("note: ", remark);
  for (const QualityCheck& check : d.checks)
    if (check.found) text += layout::wrapped("check: ", check.text);
  if (std::isfinite(d.gain.rms_before_mm))
    text +=
        fmt::format("RMS {} -> {}; cross-validated {} -> {} ({} blocks of {}positions)\n",
                    layout::um(d.gain.rms_before_mm), layout::um(d.gain.rms_after_mm),
                    layout::um(d.gain.held_out_before_mm.value),
                    layout::um(d.gain.held_out_after_mm.value), d.blocks, alone ? "" : "rotary ");
  if (!d.not_observable.empty()) text += "not seen at these positions\n" + not_observable_text(d);
  if (const MachinePlan* plan = d.next())
    text += fmt::format("next: {}, {} ({:.0f} min)\n", plan->code, plan->what, plan->minutes);
  return text;
}

std::string machine_advice_text(const MachineDiagnosis& d) {
  const MachinePlan* next = d.next();
  std::string text = next ? layout::wrapped("next: ", next_plan_text(d, PlanBy::code))
                          : "next: no plan shows or separates any further error\n";
  for (const MachinePlan& plan : d.plans) {
    std::string what = fmt::format("{:.0f} min", plan.minutes);
    if (!plan.separates.empty())
      what += fmt::format("; separates {}", fmt::join(plan.separates, ", "));
    what += plan.shows.empty() ? "; shows nothing more"
                               : fmt::format("; shows {}", fmt::join(plan.shows, " "));
    text += layout::wrapped(fmt::format("  {}: ", plan.code), what);
  }
  for (const MachineFinding& finding : d.findings) text += finding_text(finding);
  if (!d.not_observable.empty()) text += "not seen at these positions\n" + not_observable_text(d);
  return text;
}

}  // namespace trueaxis
