// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "base/threads.hpp"
#include "diagnose/advise/advise.hpp"
#include "diagnose/explain/averaged_axis.hpp"
#include "diagnose/explain/explanation.hpp"
#include "diagnose/explain/form_class.hpp"
#include "diagnose/explain/observable.hpp"
#include "diagnose/explain/quality.hpp"
#include "diagnose/refit/delay_instead.hpp"
#include "diagnose/refit/extended_fit.hpp"
#include "diagnose/refit/searched.hpp"
#include "fit/plausible.hpp"
#include "fit/probe_height.hpp"
#include "measure/angles_alike.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

using namespace diagnose_detail;

namespace {

Diagnosis not_diagnosable(Diagnosis out) {
  out.named = out.extended = out.baseline;
  out.noise.note =
      !is_diagnosed(out.baseline.surface)
          ? fmt::format("a {} is fitted and not diagnosed: cone, cylinder, plane and section are",
                        out.baseline.surface == SurfaceKind::own ? "profile of one's own"
                                                                 : to_string(out.baseline.surface))
      : out.baseline.points <= out.baseline.parameters.size()
          ? "no more readings than parameters: there are no residuals to diagnose"
      : out.baseline.status == FitStatus::implausible
          ? out.baseline.message
          : "the surface was not found: its deviations cannot be diagnosed";
  out.next.why_not = out.noise.note;
  return out;
}

/// Whether the second order of the way between two fits, d²/2R, is a tenth of the u of a mean.
bool bends_between(const FitResult& a, const FitResult& b) {
  if (b.surface == SurfaceKind::plane || b.set_ups.empty()) return false;
  double way = 0.0;
  for (const double z : {b.position_min_mm, b.position_max_mm}) {
    const auto from = a.axis.axis.at(z), to = b.axis.axis.at(z);
    way = std::max(way, std::hypot(to[0] - from[0], to[1] - from[1]));
  }
  const double bend = 0.5 * way * way / b.set_ups.front().shape.radius_mm;
  return bend > 0.1 * b.rms_mm / std::sqrt(static_cast<double>(b.points));
}

/// The model about the ideal fit, without readings that do not count if these bend it: a digit
/// typed wrong moves the axis of 200 readings by 0.3 mm, whose second order looks like two lobes.
/// @param about keeps that fit
std::unique_ptr<IdealModel> about_readings_that_count(const ProbeStream& stream,
                                                      const DiagnoseOptions& options,
                                                      const FitResult& ideal,
                                                      const DistinctValues& indicated,
                                                      FitResult& about) {
  auto out = std::make_unique<IdealModel>(stream, options, ideal, indicated);
  if (out->masked.empty()) return out;
  FitOptions bare = options.fit;  // a place is wanted, not its uncertainty
  bare.influences.clear();
  about = fit_cleaned(stream, bare, std::vector<double>(stream.size(), 0.0), out->mask, out->masked)
              .fit;
  if (!is_diagnosable(about) || !bends_between(ideal, about)) return out;
  return std::make_unique<IdealModel>(stream, options, about, indicated);
}

/// What the plan cannot see, and the next measurement.
void add_advice(const IdealModel& ideal, const RelinearisedFit& refit, const Model& model,
                const std::vector<AmbiguousFinding>& ambiguous,
                const std::vector<Unobservable>& hidden, Diagnosis& out) {
  const double sigma_mm = refit.joint().sigma_mm;
  Advice advice = advise(refit.problem(), model, ideal.stream,
                         clampings_of(out.extended, ideal.ball_mm), ambiguous, hidden, sigma_mm);
  for (std::size_t k = 0; k < out.findings.size(); ++k)
    out.findings[k].separate_with = advice.questions[k];
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    out.not_observable.push_back(hidden[k].entry);
    out.not_observable.back().separate_with = advice.hidden[k];
  }
  out.next = std::move(advice.next);
  out.plans = std::move(advice.plans);
  out.runs = std::move(advice.runs);
}

/// Lobes that even angles see as eccentricity (Eq. 315).
void add_alike(const ProbeStream& stream, Diagnosis& out) {
  const auto angles = stream.kind == StreamKind::lateral ? angles_alike(stream) : std::nullopt;
  if (!angles) return;
  NotObservable lobes;
  const auto form = std::ranges::find(effect_catalogue(), SeparatedAs::form, &Effect::separated_as);
  lobes.effect = form->id;
  lobes.why = fmt::format(
      "with {0} even angles, lobes of the orders {1} and {2} look like eccentricity: 1 µm of them "
      "moves the axis by 1 µm",
      *angles, *angles - 1, *angles + 1);
  lobes.axis_bias_per_unit = {1.0, 0.0, "mm/(mm)", ""};
  lobes.detectable = std::numeric_limits<double>::infinity();
  lobes.detectable_unit = "mm";
  out.not_observable.insert(out.not_observable.begin(), std::move(lobes));
}

std::vector<std::string> remarks_on(const Problem& problem, const Joint& joint,
                                    const Model& model) {
  std::vector<std::string> out = off_centre_remark(problem, model);
  if (model.impossible)
    out.push_back(
        fmt::format("{} ({}) fits the readings best, but at an impossible size, so TrueAxis names "
                    "no cause: check that set-ups, units and passes belong together",
                    model.impossible->id, model.impossible->title));
  for (std::string& remark : form_class_remark(problem, joint, model.others))
    out.push_back(std::move(remark));
  for (std::string& remark : alias_remark(problem.resolution)) out.push_back(std::move(remark));
  return out;
}

/// A long delay joins the class of a slip that it may be instead.
void add_delay(const IdealModel& ideal, const RelinearisedFit& refit, Diagnosis& out) {
  const auto delay = delay_instead(ideal, refit);
  if (!delay) return;
  out.late_s = delay->delay_s;
  for (Finding& slip : out.findings) {
    if (!is_step(slip.term.effect->term) || slip.may_be(delay->rival.effect)) continue;
    slip.probability *= 1.0 - delay->rival.probability;
    for (Rival& rival : slip.rivals) rival.probability *= 1.0 - delay->rival.probability;
    slip.rivals.push_back(delay->rival);
    std::ranges::stable_sort(slip.rivals, std::ranges::greater{}, &Rival::probability);
  }
}

/// Whether something was found that may make the axis better known than the ideal fit had it.
bool earned(const Diagnosis& d) {
  return !d.findings.empty() || !d.unexplained.empty() || !d.noise.masked.empty() ||
         !d.noise.interruptions.empty();
}

/// u of the axis at Z; of a plane that of its tilt.
double u_of_axis(const FitResult& fit, double z_mm) {
  return fit.surface == SurfaceKind::plane ? fit.axis.u_slopes() : fit.axis.u_at(z_mm);
}

/// Whether the axis has a smaller u than that of the ideal fit, at an end of the data.
bool is_sharper(const FitResult& fit, const FitResult& ideal) {
  if (fit.status != FitStatus::converged || ideal.status != FitStatus::converged) return false;
  return std::ranges::any_of(
      std::array{ideal.position_min_mm, ideal.position_max_mm},
      [&](double z_mm) { return u_of_axis(fit, z_mm) < u_of_axis(ideal, z_mm); });
}

/// The averaged fit; if nothing was found and that is surer of the axis, the ideal fit.
FitResult final_fit(const RelinearisedFit& refit, const AveragedAxis& average,
                    const FitResult& ideal, bool may_be_sharper) {
  BaseUncertainty base{average.within, average.between, {}};
  for (const AveragedAxis::Source& source : average.sources)
    if (source.effect && source.effect->stated)
      base.stated.push_back(
          {std::string(info_of(source.effect->stated->kind).name), source.covariance});
  FitResult averaged = refit.shifted(average.shift, std::move(base));
  return is_sharper(averaged, ideal) && !may_be_sharper ? ideal : averaged;
}

/// How sure all of it is: noise, checks of the data, gain, tests made.
void add_evidence(const IdealModel& ideal, const RelinearisedFit& refit, const Model& model,
                  const AveragedAxis& average, int threads, Diagnosis& out) {
  const Problem& problem = refit.problem();
  const Joint& joint = refit.joint();
  out.noise = report_noise(ideal.stream, joint, out.residual_after_mm, ideal.masked,
                           ideal.fit_options.noise_mm);
  for_each_index(4, threads, [&](std::size_t k) {
    if (k == 0) out.gain = measure_gain(problem, joint, average, out.noise.sigma_mm);
    if (k == 1) out.checks = check_quality(ideal, joint, out.residual_after_mm, out.noise);
    if (k == 2)
      out.spectrum = spectrum_of(problem.point, ideal.resolution, out.residual_before_mm,
                                 out.residual_after_mm);
    if (k == 3) out.remarks = remarks_on(problem, joint, model);
  });
  out.hypotheses = static_cast<std::size_t>(model.family.single + model.family.bandwidth);
  out.threshold = model.family.threshold(out.false_alarm);
  out.effective_hypotheses = out.false_alarm / std::exp(-0.5 * out.threshold);
}

/// The options with what is stated in the entries of the effects that it is of, and no longer among
/// the influences of a fit.
DiagnoseOptions with_entries(DiagnoseOptions options, Diagnosis& out) {
  std::vector<Effect> entries(options.own_effects.begin(), options.own_effects.end());
  std::erase_if(options.fit.influences, [&](const Influence& influence) {
    const auto of =
        std::ranges::find(effect_catalogue(), std::optional(influence.kind), &Effect::stated_as);
    if (of == effect_catalogue().end()) return false;
    entries.push_back(as_stated(*of, influence));
    return true;
  });
  if (entries.size() > options.own_effects.size()) {
    out.entries = std::make_shared<const std::vector<Effect>>(std::move(entries));
    options.own_effects = *out.entries;
  }
  out.own_effects = options.own_effects;
  return options;
}

}  // namespace

Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& asked) {
  expects(asked.false_alarm > 0.0 && asked.false_alarm < 1.0, "a false alarm rate in (0, 1)");
  for (const Effect& own : asked.own_effects)
    expects(find_effect(own.id) == nullptr, "an effect of one's own has an id of its own");
  Diagnosis out;
  const DiagnoseOptions options = with_entries(asked, out);
  out.false_alarm = options.false_alarm;
  out.known = asked.fit.influences;
  const int threads = threads_beside(stream.size(), options.threads);
  DistinctValues indicated;
  for_each_index(2, threads, [&](std::size_t k) {
    if (k == 0) out.baseline = fit(stream, asked.fit);
    if (k == 1) indicated = distinct_values(stream.reading_mm);
  });
  if (!is_diagnosable(out.baseline)) return not_diagnosable(std::move(out));

  FitResult about;
  const std::unique_ptr<IdealModel> model =
      about_readings_that_count(stream, options, out.baseline, indicated, about);
  IdealModel& ideal = *model;
  Searched found = searched(ideal);
  const std::size_t columns = found.fit->joint().solution.columns.size();
  if (ideal.exclude_far_from(found.fit->residual_mm(), columns) ||
      (!found.at_rest_mm.empty() && ideal.exclude_far_from(found.at_rest_mm, columns)))
    found = searched(ideal);
  CoarseToFineSearch& search = *found.search;
  std::unique_ptr<RelinearisedFit>& refit = found.fit;
  Explanation explanation;
  for_each_index(2, threads, [&](std::size_t k) {
    if (k == 0) explanation = explain(search, *refit, found.timing);
    if (k == 1) refit->fit_surface();
  });
  while (std::optional<Model> other = with_likeliest_rival(search.model, explanation)) {
    std::optional<Timing> of_other;
    auto rival = relinearise(ideal, *other, of_other);
    if (!(rival->criterion() < refit->criterion())) break;
    search.about(*found.about);  // not the part that goes
    search.model = std::move(*other), refit = std::move(rival), found.timing = of_other;
    explanation = explain(search, *refit, found.timing);
    refit->fit_surface();
  }

  out.findings = std::move(explanation.findings);
  add_delay(ideal, *refit, out);
  out.unexplained = std::move(explanation.unexplained);
  out.verdict = verdict_of(!out.findings.empty(), !out.unexplained.empty());
  const std::vector<Unobservable> hidden = unobservable_effects(
      refit->problem(), search.model, explanation.ambiguous, refit->joint().sigma_mm);
  const AveragedAxis average =
      average_axis(refit->problem(), refit->joint(), explanation.ambiguous, search.model.others);
  out.limits = limits_of(refit->problem().point, average);
  out.refuted = refuted_statements(out.findings, out.own_effects);
  out.shares = average.shares;
  out.shares.insert(out.shares.end(), explanation.improbable.begin(), explanation.improbable.end());
  out.noise.masked = ideal.masked;
  const bool may_be_sharper = earned(out);
  for_each_index(2, threads, [&](std::size_t k) {
    if (k == 0) {
      out.extended = final_fit(*refit, average, out.baseline, may_be_sharper);
      out.named = refit->take_named();
    }
    if (k == 1) {
      out.effect_mm = refit->effect_mm();
      out.residual_before_mm = out.baseline.residual_mm;
      out.residual_after_mm = refit->residual_mm();
      add_evidence(ideal, *refit, search.model, average, threads, out);
    }
  });
  for (FitResult* one : {&out.named, &out.extended})
    add_square_of_height(asked.fit.influences, *one);
  expects(may_be_sharper || !is_sharper(out.extended, out.baseline),
          "if no cause was found, U of the final axis is at least that of the ideal fit");
  const LinearisationPoint& point = refit->problem().point;
  out.z_mid_mm = point.z_mid_mm, out.z_half_mm = point.z_half_mm;
  add_advice(ideal, *refit, search.model, explanation.ambiguous, hidden, out);
  add_alike(stream, out);
  std::ranges::stable_sort(out.findings, [](const Finding& a, const Finding& b) {
    return a.axis_shift.value > b.axis_shift.value;
  });
  if (const std::string why = implausible_size(out); !why.empty())
    for (FitResult* fit : {&out.baseline, &out.named, &out.extended}) refuse(*fit, why);
  if (out.slip() && out.slip()->rivals.empty())
    out.remarks.push_back("the part slipped: the axis is that of the part after the slip");
  return out;
}

bool Finding::may_be(std::string_view id) const {
  return id == effect() || std::ranges::find(rivals, id, &Rival::effect) != rivals.end();
}

const char* to_string(NoiseSource source) {
  static constexpr const char* words[] = {"", "residuals of the final fit", "stationary capture",
                                          "repeated passes", "revolution differences"};
  return words[static_cast<std::size_t>(source)];
}

const Effect* Diagnosis::entry(std::string_view id) const { return find_effect(id, own_effects); }

const Finding* Diagnosis::slip() const {
  const auto found = std::ranges::find_if(
      findings, [](const Finding& finding) { return is_step(finding.term.effect->term); });
  return found == findings.end() ? nullptr : &*found;
}

}  // namespace trueaxis
