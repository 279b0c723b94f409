// SPDX-License-Identifier: Apache-2.0
#include "job/conclude.hpp"

#include <algorithm>
#include <iterator>

#include "correct/coaxiality_distribution.hpp"
#include "job/check.hpp"
#include "job/checks.hpp"
#include "job/datum_axes.hpp"
#include "job/doubts.hpp"
#include "job/inclusion.hpp"
#include "job/machine_motion.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/target_datum.hpp"
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

void plan_cut(PlannedJob& plan) {
  const TargetSurface& target = *plan.job.target;
  plan.datum = target_datum(plan);
  const std::vector<Reference> references = references_of(plan);
  plan.target_axis = solve_target_axis(judged(plan, references_aimed_at(plan)), target.z_start_mm,
                                       target.z_end_mm, target.kind != TargetKind::face);
  const TargetAxis& solved = *plan.target_axis;
  plan.target_axis->remainders =
      limited_remainders(judged(plan, references), solved.axis.axis, target);
  if (plan.datum) plan.datum->references = limited_remainders(references, solved.axis.axis, target);
  IncludedMotions included = included_motions(plan);
  plan.inclusions = std::move(included.inclusions);
  std::ranges::move(followed(plan.job.loop.motion), std::back_inserter(included.motions));
  plan.correction = make_correction(solved.axis, target, plan.job.tool, plan.job.actuator,
                                    std::move(included.motions), plan.job.loop);
  for (const ControlTable& output : plan.job.outputs)
    plan.control_files.push_back(make_control_table(*plan.correction, output));
}

/// The cut, where nothing forbids to plan one.
PlannedJob planned(IdentifiedJob identified) {
  PlannedJob plan{std::move(identified)};
  require_stock(plan);
  const bool slipped = !part_slipped(plan).empty() || !slipped_between_references(plan).empty();
  if (slipped && !plan.agreement.disagreements.empty()) plan.agreement = {};
  if (!first_found(Weight::forbids, CheckedAt::references, {plan, {}}).empty()) return plan;
  try {
    for (std::size_t i = 0; i < plan.fits.size(); ++i)
      plan.associated.push_back(associated_difference(plan, i));
    if (plan.job.target) plan_cut(plan);
  } catch (const Refusal& refusal) {
    plan.refused = refusal.what();
  }
  return plan;
}

/// Takes what says where the part is out of the fits of every reference of which that is not known.
void withhold_axes(JobResult& result) {
  result.axis_unknown.resize(result.fits.size());
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    std::optional<Reason>& why = result.axis_unknown[i];
    auto* diagnosis =
        i < result.diagnoses.size() && result.diagnoses[i] ? &*result.diagnoses[i] : nullptr;
    if (diagnosis) why = why_axis_unknown(result.streams[i], *diagnosis);
    if (const auto slipped = slipped_since(result, i); slipped && !why)
      why = Reason{ReasonCode::slipped_between_references, {*slipped}};
    if (!why) continue;
    withhold_axis(result.fits[i], to_string(why->code));
    if (diagnosis) withhold_axis(*diagnosis, to_string(why->code));
  }
}

}  // namespace

JobResult conclude(IdentifiedJob identified, std::vector<PartForm> forms) {
  JobResult result{planned(std::move(identified)), std::move(forms)};
  result.verdict = decide(result, result.forms);
  if (!result.correction) withhold_axes(result);
  return result;
}

}  // namespace trueaxis
