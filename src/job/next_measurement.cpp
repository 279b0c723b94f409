// SPDX-License-Identifier: Apache-2.0
#include "job/next_measurement.hpp"

#include <algorithm>

namespace trueaxis {

const NextMeasurement* next_measurement(const JobResult& result) {
  if (std::ranges::find(result.verdict.reasons, ReasonCode::part_slipped, &Reason::code) !=
      result.verdict.reasons.end())
    return nullptr;
  const auto gain = [](const NextMeasurement& next) {
    return next.power_after - next.power_before;
  };
  const NextMeasurement* best = nullptr;
  for (const auto& diagnosis : result.diagnoses) {
    if (!diagnosis || diagnosis->next.plan.empty() ||
        (diagnosis->findings.empty() && diagnosis->unexplained.empty()))
      continue;
    if (best == nullptr || gain(diagnosis->next) > gain(*best)) best = &diagnosis->next;
  }
  return best;
}

}  // namespace trueaxis
