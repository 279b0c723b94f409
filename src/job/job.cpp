// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/job.hpp"

#include <algorithm>
#include <utility>

#include "job/agreement.hpp"
#include "job/conclude.hpp"
#include "job/datum_axes.hpp"
#include "job/part_form_steps.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

/// Fits, what they tell of each other, and the diagnosis of each.
IdentifiedJob identified(Job job, std::vector<ProbeStream> streams) {
  IdentifiedJob out{std::move(job), std::move(streams), {}, {}, {}, {}};
  for (std::size_t i = 0; i < out.streams.size(); ++i) {
    const FitOptions& options = out.job.references[i].fit;
    out.streams[i] = corrected_by_known(std::move(out.streams[i]), options);
    out.fits.push_back(fit(out.streams[i], options));
  }
  out.agreement = hold_together(out);
  for (std::size_t i = 0; i < out.streams.size(); ++i) {
    auto& diagnosis = out.diagnoses.emplace_back();
    auto& again = out.resimulations.emplace_back();
    if (out.fits[i].status != FitStatus::converged) continue;
    DiagnoseOptions options;
    options.fit = out.job.references[i].fit;
    diagnosis = diagnose(out.streams[i], options);
    if (diagnosis->baseline.status == FitStatus::implausible) {
      out.fits[i] = diagnosis->baseline;
      diagnosis.reset();
    } else {
      again = resimulate(*diagnosis, out.streams[i], options.fit.ball_radius_mm);
    }
  }
  return out;
}

/// What run-out is about; nothing: the spindle axis.
std::optional<std::size_t> datum_of(const IdentifiedJob& result, const FormTask& task) {
  for (std::size_t i = 0; i < result.job.references.size(); ++i)
    if (task.runout_tolerance_mm && result.job.references[i].name == task.runout_datum) return i;
  return {};
}

/// For every reference, if the job asks for values of form.
std::vector<PartForm> forms_of(const IdentifiedJob& result) {
  std::vector<PartForm> forms;
  const bool judged = std::ranges::any_of(result.job.references,
                                          [](const JobReference& r) { return r.form.judges(); });
  if (!judged && !result.job.values_of_form) return forms;
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
      forms.push_back(std::move(none));
      continue;
    }
    const auto datum = datum_of(result, reference.form);
    const DiagnosedStream of_part = diagnosed(i), of_datum = diagnosed(datum.value_or(i));
    forms.push_back(part_form(of_part, reference.fit, reference.form, datum ? &of_datum : nullptr));
  }
  return forms;
}

}  // namespace

bool forms_met(const JobResult& result) {
  return std::ranges::all_of(result.forms, &PartForm::met);
}

std::optional<double> coaxiality_of_cut_not_met_mm(const JobResult& result) {
  const auto& tolerance_mm = result.job.coaxiality_tolerance_mm;
  if (!result.feedback || !result.feedback->seen || !tolerance_mm) return {};
  const double least_mm = 2.0 * (result.feedback->off_mm - result.feedback->U_off_mm);
  return least_mm > *tolerance_mm ? std::optional(least_mm) : std::nullopt;
}

JobResult run_job(Job job, std::vector<ProbeStream> streams) {
  expects(job.references.size() == streams.size() && !streams.empty(), "one stream per reference");
  IdentifiedJob found = identified(std::move(job), std::move(streams));
  std::vector<PartForm> forms = forms_of(found);
  JobResult result = conclude(std::move(found), std::move(forms));
  for (std::size_t i = 0; i < result.forms.size(); ++i)
    result.datum_axes.push_back(datum_axes(result, i));
  return result;
}

}  // namespace trueaxis
