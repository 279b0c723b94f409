// SPDX-License-Identifier: Apache-2.0
#include "job/conclude.hpp"

#include <algorithm>

#include "correct/coaxiality_distribution.hpp"
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
  const std::vector<Reference> references = references_of(result);
  result.target_axis = solve_target_axis(references_aimed_at(result), target.z_start_mm,
                                         target.z_end_mm, target.kind != TargetKind::face);
  TargetAxis& solved = *result.target_axis;
  solved.remainders =
      remainders_of(references, solved.axis.axis, target.z_start_mm, target.z_end_mm);
  for (std::size_t i = 0; i < references.size(); ++i) {
    solved.remainders[i].limit_mm = CoaxialityDistribution({&references[i], 1}, solved.axis.axis,
                                                           target.z_start_mm, target.z_end_mm)
                                        .quantile(1.0 - nonconformity_risk);
  }
  result.correction = make_correction(result.target_axis->axis, target, result.job.tool,
                                      result.job.actuator, included_motions(result));
}

}  // namespace

void conclude(JobResult& result) {
  require_stock(result);
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  const bool slipped = !slip_objection(result).empty();
  if (slipped) {
    withhold_axes(result);
    if (!result.agreement.disagreements.empty()) result.agreement = {};
  }
  if (fitted && result.job.target && !slipped && result.agreement.reason.empty()) {
    try {
      correct(result);
    } catch (const Refusal& refusal) {
      result.refused = refusal.what();
    }
  }
  result.verdict = decide(result);
}

}  // namespace trueaxis
