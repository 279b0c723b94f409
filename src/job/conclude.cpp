// SPDX-License-Identifier: Apache-2.0
#include "job/conclude.hpp"

#include <algorithm>

#include "job/cut_checks.hpp"
#include "job/inclusion.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/verdict.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

void correct(JobResult& result) {
  const TargetSurface& target = *result.job.target;
  result.target_axis = solve_target_axis(references_of(result), target.z_start_mm, target.z_end_mm,
                                         target.kind != TargetKind::face);
  result.correction = make_correction(result.target_axis->axis, target, result.job.tool,
                                      result.job.actuator, included_motions(result));
}

}  // namespace

void conclude(JobResult& result) {
  require_stock(result);
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  const bool slipped = std::ranges::any_of(
      result.diagnoses, [](const auto& diagnosis) { return diagnosis && diagnosis->slip(); });
  if (slipped) withhold_axes(result);
  if (fitted && result.job.target && !slipped) {
    try {
      correct(result);
    } catch (const Refusal& refusal) {
      result.refused = refusal.what();
    }
  }
  result.verdict = decide(result);
}

}  // namespace trueaxis
