// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/job.hpp"

#include <utility>

#include "job/agreement.hpp"
#include "job/conclude.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

void diagnose_all(JobResult& result) {
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    result.diagnoses.emplace_back();
    result.resimulations.emplace_back();
    if (result.fits[i].status != FitStatus::converged) continue;
    DiagnoseOptions options;
    options.fit = result.job.references[i].fit;
    result.diagnoses[i] = diagnose(result.streams[i], options);
    result.resimulations[i] =
        resimulate(*result.diagnoses[i], result.streams[i], options.fit.ball_radius_mm);
  }
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
  conclude(result);
  return result;
}

}  // namespace trueaxis
