// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "trueaxis/job.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string left_over(const Comparison& c) {
  char text[160];
  std::snprintf(text, sizeof text,
                "simulated with them, %.3g µm RMS are left (%.0f %% of the variance), with the "
                "ideal surface %.3g µm",
                c.after.rms_mm / mm_per_um, 100.0 * c.after.share, c.before.rms_mm / mm_per_um);
  return text;
}

std::string advice(const Diagnosis& diagnosis) {
  return diagnosis.next.plan.empty() || diagnosis.next.what.empty() ? "probe again"
                                                                    : diagnosis.next.what;
}

}  // namespace

void judge_resimulations(JobResult& result) {
  if (!result.verdict.go) return;
  for (std::size_t i = 0; i < result.resimulations.size(); ++i) {
    const auto& again = result.resimulations[i];
    if (!again || !again->why_not.empty() || !refuted(again->comparison)) continue;
    const std::string& reference = result.job.references[i].name;
    result.verdict.go = false;
    result.verdict.line =
        "NO-GO: " + (reference.empty() ? "" : reference + ": ") +
        "what was found does not reproduce the readings: " + left_over(again->comparison) + ": " +
        advice(*result.diagnoses[i]);
    return;
  }
}

}  // namespace trueaxis
