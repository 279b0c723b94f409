// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/job.hpp"

#include <algorithm>
#include <utility>

#include "job/agreement.hpp"
#include "job/inclusion.hpp"
#include "job/references.hpp"
#include "job/slip.hpp"
#include "job/verdict.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

void diagnose_all(JobResult& result) {
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    result.diagnoses.emplace_back();
    result.resimulations.emplace_back();
    if (result.streams[i].kind == StreamKind::face) continue;
    if (result.fits[i].status != FitStatus::converged) continue;
    DiagnoseOptions options;
    options.fit = result.job.references[i].fit;
    result.diagnoses[i] = diagnose(result.streams[i], options);
    result.resimulations[i] =
        resimulate(*result.diagnoses[i], result.streams[i], options.fit.ball_radius_mm);
  }
}

void correct(JobResult& result) {
  const TargetSurface& target = *result.job.target;
  result.target_axis = solve_target_axis(references_of(result), target.z_start_mm, target.z_end_mm,
                                         target.kind != TargetKind::face);
  result.correction = make_correction(result.target_axis->axis, target, result.job.tool,
                                      result.job.actuator, included_motions(result));
}

}  // namespace

JobResult run_job(Job job, std::vector<ProbeStream> streams) {
  expects(job.references.size() == streams.size() && !streams.empty(), "one stream per reference");
  JobResult result;
  result.job = std::move(job);
  result.streams = std::move(streams);
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    result.fits.push_back(fit(result.streams[i], result.job.references[i].fit));
  }
  result.agreement = hold_together(result);
  diagnose_all(result);
  const bool fitted = std::ranges::all_of(
      result.fits, [](const FitResult& fit) { return fit.status == FitStatus::converged; });
  const bool slipped = std::ranges::any_of(
      result.diagnoses, [](const auto& diagnosis) { return diagnosis && diagnosis->slip(); });
  if (slipped) {
    withhold_axes(result);
    if (!result.agreement.disagreements.empty()) result.agreement = {};
  }
  if (fitted && result.job.target && !slipped && result.agreement.reason.empty()) correct(result);
  result.verdict = decide(result);
  return result;
}

}  // namespace trueaxis
