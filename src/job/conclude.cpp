// SPDX-License-Identifier: Apache-2.0
#include "job/conclude.hpp"

#include <algorithm>

#include "correct/coaxiality_distribution.hpp"
#include "job/associated_axis.hpp"
#include "job/cut_checks.hpp"
#include "job/doubts.hpp"
#include "job/inclusion.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/target_datum.hpp"
#include "job/verdict.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

std::vector<Remainder> limited_remainders(std::span<const Reference> references, const Axis& axis,
                                          const TargetSurface& target) {
  std::vector<Remainder> out = remainders_of(references, axis, target.z_start_mm, target.z_end_mm);
  for (std::size_t i = 0; i < references.size(); ++i)
    out[i].limit_mm =
        CoaxialityDistribution({&references[i], 1}, axis, target.z_start_mm, target.z_end_mm)
            .quantile(1.0 - nonconformity_risk);
  return out;
}

/// What says where the part is, of every reference of which that is not known.
void withhold_axes(JobResult& result) {
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    Diagnosis& diagnosis = *result.diagnoses[i];
    const std::string why = why_axis_unknown(result.streams[i], diagnosis);
    if (why.empty()) continue;
    for (FitResult* fit :
         {&result.fits[i], &diagnosis.baseline, &diagnosis.named, &diagnosis.extended})
      withhold_axis(*fit, why);
  }
}

void correct(JobResult& result) {
  const TargetSurface& target = *result.job.target;
  result.datum = target_datum(result);
  const std::vector<Reference> references = references_of(result);
  result.target_axis =
      solve_target_axis(judged(result, references_aimed_at(result)), target.z_start_mm,
                        target.z_end_mm, target.kind != TargetKind::face);
  TargetAxis& solved = *result.target_axis;
  solved.remainders = limited_remainders(judged(result, references), solved.axis.axis, target);
  if (result.datum)
    result.datum->references = limited_remainders(references, solved.axis.axis, target);
  result.correction = make_correction(result.target_axis->axis, target, result.job.tool,
                                      result.job.actuator, included_motions(result));
  for (const ControlTable& output : result.job.outputs)
    result.control_files.push_back(make_control_table(*result.correction, output));
}

}  // namespace

void conclude(JobResult& result) {
  require_stock(result);
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  const bool slipped = !slip_objection(result).empty();
  if (slipped && !result.agreement.disagreements.empty()) result.agreement = {};
  if (fitted && !slipped && result.agreement.reason.empty()) {
    try {
      for (std::size_t i = 0; i < result.fits.size(); ++i)
        result.associated.push_back(associated_difference(result, i));
      if (result.job.target) correct(result);
    } catch (const Refusal& refusal) {
      result.refused = refusal.what();
    }
  }
  result.verdict = decide(result);
  if (!result.correction) withhold_axes(result);
}

}  // namespace trueaxis
