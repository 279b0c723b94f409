// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/job.hpp"

#include <algorithm>
#include <utility>

#include "job/agreement.hpp"
#include "job/conclude.hpp"
#include "job/datum_axes.hpp"
#include "job/form_judgement.hpp"
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
    if (result.diagnoses[i]->baseline.status == FitStatus::implausible) {
      result.fits[i] = result.diagnoses[i]->baseline;
      result.diagnoses[i].reset();
      continue;
    }
    result.resimulations[i] =
        resimulate(*result.diagnoses[i], result.streams[i], options.fit.ball_radius_mm);
  }
}

/// What run-out is about; nothing: the spindle axis.
std::optional<std::size_t> datum_of(const JobResult& result, const FormTask& task) {
  for (std::size_t i = 0; i < result.job.references.size(); ++i)
    if (task.runout_tolerance_mm && result.job.references[i].name == task.runout_datum) return i;
  return {};
}

void assess_forms(JobResult& result) {
  const auto diagnosed = [&](std::size_t i) {
    return DiagnosedStream{result.streams[i],
                           result.diagnoses[i] ? &*result.diagnoses[i] : nullptr};
  };
  for (std::size_t i = 0; i < result.streams.size(); ++i) {
    const JobReference& reference = result.job.references[i];
    if (result.fits[i].status == FitStatus::implausible) {
      PartForm none;
      none.why_not = "the readings are refused";
      judge(reference.form, none);
      result.forms.push_back(std::move(none));
      continue;
    }
    const auto datum = datum_of(result, reference.form);
    const DiagnosedStream of_part = diagnosed(i), of_datum = diagnosed(datum.value_or(i));
    result.forms.push_back(
        part_form(of_part, reference.fit, reference.form, datum ? &of_datum : nullptr));
  }
}

}  // namespace

bool forms_met(const JobResult& result) {
  return std::ranges::all_of(result.forms, &PartForm::met);
}

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
  const bool judged = std::ranges::any_of(result.job.references,
                                          [](const JobReference& r) { return r.form.judges(); });
  if (judged || result.job.values_of_form) assess_forms(result);
  conclude(result);
  reserve_forms(result);
  for (std::size_t i = 0; i < result.forms.size(); ++i)
    result.datum_axes.push_back(datum_axes(result, i));
  return result;
}

}  // namespace trueaxis
