// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/threads.hpp"
#include "diagnose/advise/advise.hpp"
#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/explain/describe.hpp"
#include "diagnose/explain/gain.hpp"
#include "diagnose/explain/rival_axes.hpp"
#include "diagnose/explain/sources.hpp"
#include "diagnose/explain/spectrum.hpp"
#include "diagnose/refit/extended_fit.hpp"
#include "diagnose/refit/relinearised_fit.hpp"
#include "diagnose/regression/noise.hpp"
#include "diagnose/search/coarse_to_fine_search.hpp"
#include "math/statistics.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

using namespace diagnose_detail;

namespace {

double ball_of(const ProbeStream& stream, const FitOptions& options) {
  return std::max(stream.ball_radius_mm.value_or(0.0), options.ball_radius_mm);
}

Finding finding_of(const Problem& problem, const Model& model, const Joint& joint,
                   const ConfounderSet& found, const Resolution& resolution, std::size_t term) {
  Finding out;
  out.term = fitted(model.terms[term], joint.of(term), covariance_of(joint, term));
  out.rivals = found.rivals;
  out.probability = found.probability;
  out.parameters = parameters_of(problem, model, joint, term);
  out.alias = alias_of(model.terms[term], resolution);
  out.p_value = model.p_values[term];
  return out;
}

void add_axis_bias(const Joint& joint, std::size_t term, Estimate& shift, bool& cosmetic) {
  const Solution without = joint.without(term);
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  const double variance = joint.sigma_mm * joint.sigma_mm;
  const AxisShift moved =
      axis_shift(joint.equations.point(), joint.base() - without.coefficients.head(n),
                 variance * (joint.solution.inverse.topLeftCorner(n, n) -
                             without.inverse.topLeftCorner(n, n)));
  shift = {moved.value_mm, moved.u_mm, "mm", ""};
  const double u = axis_uncertainty(joint.equations.point(), joint.base_covariance()).u_mm;
  cosmetic = moved.value_mm < 2.0 * u;
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& options) {
  expects(options.false_alarm > 0.0 && options.false_alarm < 1.0, "a false alarm rate in (0, 1)");
  Diagnosis out;
  out.false_alarm = options.false_alarm;
  out.baseline = fit(stream, options.fit);
  out.extended = out.baseline;
  if (!is_diagnosable(out.baseline)) {
    out.noise.note =
        out.baseline.surface == SurfaceKind::plane
            ? "faces are not diagnosed: the catalogue's terms are those of X_M"
        : out.baseline.surface == SurfaceKind::own
            ? "a profile of one's own is not diagnosed: only the catalogue's surfaces are"
            : "the surface was not found: nothing can be said beside it";
    out.next.why_not = out.noise.note;
    return out;
  }
  const int threads = static_cast<int>(threads_for(options.threads, stream.size()));
  const double ball_mm = ball_of(stream, options.fit);
  const std::vector<Clamping> clampings = clampings_of(out.baseline, ball_mm);
  const BaseKind base = base_of(stream, out.baseline, clampings);
  const LinearisationPoint first = linearise_at(stream, clampings, base, options.fit.bore);
  ObservationMask mask = make_observation_mask(first);
  const Resolution resolution = resolution_of(first, mask);
  const std::vector<double> deviation = deviation_from(stream, first);
  std::vector<Rejected> masked = mask_outliers(
      first, small_fourier_legendre_basis(first, resolution), deviation, mask, threads);
  const auto most = static_cast<std::size_t>(options.max_findings);
  const Problem whole{first, mask, resolution, deviation, options.false_alarm, threads, most};
  CoarseToFineSearch coarse_to_fine(whole);
  std::optional<Timing> timing;
  const std::unique_ptr<RelinearisedFit> refined = relinearise(
      {stream, options.fit, out.baseline, ball_mm, masked, whole}, coarse_to_fine.model, timing);
  const Model& model = coarse_to_fine.model;
  const Problem& problem = refined->problem();
  const LinearisationPoint& second = problem.point;
  const Joint& joint = refined->joint();
  out.effect_mm = refined->effect_mm();
  out.residual_before_mm = out.baseline.residual_mm;
  out.residual_after_mm =
      remainder(second, problem.deviation_mm, joint.terms, joint.solution.coefficients);
  out.z_mid_mm = second.z_mid_mm, out.z_half_mm = second.z_half_mm;

  std::vector<AmbiguousFinding> questions;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (!model.terms[t].effect) {
      Unexplained left = unexplained_of(joint, t);
      left.p_value = model.p_values[t];
      out.unexplained.push_back(std::move(left));
      continue;
    }
    questions.push_back({t, coarse_to_fine.distinguish(t)});
    if (timing && timing->term == t) narrow(questions.back().found, timing->likelihood_ratio);
    Finding finding = finding_of(problem, model, joint, questions.back().found, resolution, t);
    add_axis_bias(joint, t, finding.axis_shift, finding.cosmetic);
    finding.rms_mm = rms_of(joint.contribution_of(t));
    out.findings.push_back(std::move(finding));
  }
  const Eigen::MatrixXd between = between_causes(problem, joint, questions);
  out.extended = refined->extended(between);
  const std::vector<Unobservable> hidden = unobservable_effects(problem, model, joint.sigma_mm);
  Advice advice = advise(problem, model, stream, clampings_of(out.extended, ball_mm), questions,
                         hidden, joint.sigma_mm);
  for (std::size_t k = 0; k < out.findings.size(); ++k)
    out.findings[k].separate_with = advice.questions[k];
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    out.not_observable.push_back(hidden[k].entry);
    out.not_observable.back().separate_with = advice.hidden[k];
  }
  out.next = std::move(advice.next);
  out.plans = std::move(advice.plans);
  std::ranges::stable_sort(out.findings, [](const Finding& a, const Finding& b) {
    return a.axis_shift.value > b.axis_shift.value;
  });
  out.verdict = !out.unexplained.empty() ? DiagnosisVerdict::unexplained
                : !out.findings.empty()  ? DiagnosisVerdict::effects
                                         : DiagnosisVerdict::ideal;
  out.noise =
      report_noise(stream, joint, out.residual_after_mm, std::move(masked), options.fit.noise_mm);
  out.checks = check_quality(stream, joint, out.residual_after_mm, out.noise);
  out.remarks = off_centre_remark(problem, model);
  out.gain = measure_gain(problem, joint, between, out.noise.sigma_mm);
  out.hypotheses = static_cast<std::size_t>(model.family.single + model.family.bandwidth);
  out.threshold = model.family.threshold(options.false_alarm);
  out.effective_hypotheses = options.false_alarm / std::exp(-0.5 * out.threshold);
  out.spectrum = spectrum_of(second, resolution, out.residual_before_mm, out.residual_after_mm);
  return out;
}

std::vector<std::string> Finding::members() const {
  std::vector<std::string> ids{effect()};
  for (const Rival& rival : rivals) ids.push_back(rival.effect);
  return ids;
}

bool Finding::may_be(std::string_view id) const {
  return id == effect() || std::ranges::find(rivals, id, &Rival::effect) != rivals.end();
}

const char* to_string(DiagnosisVerdict verdict) {
  switch (verdict) {
    case DiagnosisVerdict::ideal:
      return "ideal";
    case DiagnosisVerdict::effects:
      return "effects";
    case DiagnosisVerdict::unexplained:
      return "unexplained";
  }
  return "";
}

}  // namespace trueaxis
