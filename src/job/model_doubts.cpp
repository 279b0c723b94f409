// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "infer/classes.hpp"
#include "job/checks.hpp"
#include "job/doubts.hpp"
#include "measure/passes.hpp"

namespace trueaxis {
namespace {

/// What of a diagnosis is not settled; none: every cause has its name.
Reasons open_causes(const Diagnosis& diagnosis) {
  Reasons open;
  for (const Finding& finding : diagnosis.findings)
    if (!finding.rivals.empty() && !finding.cosmetic)
      open.push_back({ReasonCode::finding_has_rival,
                      {},
                      {},
                      {{"effect", finding.effect()}, {"rival", finding.rivals[0].effect}}});
  if (!diagnosis.unexplained.empty()) open.push_back({ReasonCode::pattern_without_cause});
  return open;
}

/// Whether all passes that turn run at one speed and not in both directions of Z.
bool one_manner(const std::vector<Pass>& passes) {
  const Pass* first = nullptr;
  for (const Pass& p : passes) {
    if (p.c_sign == 0 || p.readings_per_revolution <= 0.0) continue;
    if (!first) first = &p;
    const double apart = std::abs(p.speed_rad_per_s - first->speed_rad_per_s);
    if (apart > 0.01 * std::abs(first->speed_rad_per_s) || p.feed_sign != first->feed_sign)
      return false;
  }
  return true;
}

bool is_bow(const Finding& finding) {
  const auto* harmonic = std::get_if<Harmonic>(&finding.term.effect->term);
  return harmonic && harmonic->fixed_order == 1.0 &&
         harmonic->envelope == Harmonic::Envelope::parabola;
}

constexpr Threshold far_out{"moved", 3.0, "of the tolerance", "which is a diameter"};
constexpr Threshold in_no_class{"probability", infer::in_no_class, "1",
                                "what is less probable is in no class"};
constexpr Threshold over_stated{"left", 0.5, "of the stated noise", "and 3 u of it"};

/// Of each reference that has one.
template <typename Find>
Reasons of_each(const IdentifiedJob& job, Find find) {
  Reasons list;
  for (std::size_t i = 0; i < job.fits.size(); ++i)
    if (std::optional<Reason> one = find(i)) list.push_back(std::move(*one));
  return list;
}

Reasons find_undiagnosed(const CheckInput& in) {
  return of_each(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (in.job.diagnoses[i] || !(in.job.fits[i].u_factor > 1.0)) return {};
    return Reason{ReasonCode::undiagnosed_correlated, {i}};
  });
}

Reasons find_noise_over_stated(const CheckInput& in) {
  return of_each(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (!in.job.diagnoses[i]) return {};
    const Diagnosis& diagnosis = *in.job.diagnoses[i];
    const double stated_mm = diagnosis.noise.stated_mm.value_or(0.0);
    const double left_mm = std::max(diagnosis.noise.sigma_mm, diagnosis.gain.rms_after_mm);
    const double room_mm =
        std::max(over_stated.value * stated_mm, 3.0 * diagnosis.noise.u_sigma_mm);
    if (!(stated_mm > 0.0 && left_mm - stated_mm > room_mm)) return {};
    return Reason{ReasonCode::noise_over_stated,
                  {i},
                  {{"left", left_mm, "mm"}, {"times", left_mm / stated_mm}}};
  });
}

Reasons find_bow(const CheckInput& in) {
  return of_each(in.job, [&](std::size_t i) -> std::optional<Reason> {
    if (!in.job.diagnoses[i]) return {};
    const ProbeStream& stream = in.job.streams.at(i);
    const bool one_pass = stream.size() > 0 && one_manner(find_passes(stream));
    if (!one_pass || !std::ranges::any_of(in.job.diagnoses[i]->findings, is_bow)) return {};
    return Reason{ReasonCode::bow_or_vibration, {i}};
  });
}

Reasons find_open_axes(const CheckInput& in) { return open_axes(in.job); }

Reasons find_improbable(const CheckInput& in) {
  return first_diagnosed(in.job, [&](std::size_t i) -> std::optional<Reason> {
    const Diagnosis& diagnosis = *in.job.diagnoses[i];
    for (const AxisShare& share : diagnosis.shares) {
      const double out_mm = 2.0 * share.axis_shift.value;
      if (share.probability >= in_no_class.value || share.effect.empty() ||
          share.instead_of.empty() || out_mm <= far_out.value * *in.job.job.coaxiality_tolerance_mm)
        continue;
      const Effect* effect = diagnosis.entry(share.effect);
      if (!effect || effect->separations.empty()) continue;
      const Separation& tells = effect->separations.front();
      const auto plan = std::ranges::find(diagnosis.plans, tells.code, &Separating::plan);
      const std::string what = plan == diagnosis.plans.end() ? std::string(tells.how) : plan->what;
      const std::string code(tells.code);
      return Reason{ReasonCode::improbable_and_far,
                    {},
                    {{"shift", share.axis_shift.value, "mm"}},
                    {{"effect", share.instead_of}, {"rival", share.effect}},
                    {},
                    {{ReasonCode::measure, {}, {}, {{"plan", code}, {"what", what}}}}};
    }
    return {};
  });
}

constexpr Threshold of_stated[] = {over_stated};
constexpr Threshold of_improbable[] = {in_no_class, far_out};
constexpr Threshold of_open[] = {{"moved", 1.0, "of U", "what is less is within it"}};
constexpr Threshold of_correlated[] = {{"u_factor", 1.0, "1", "more: residuals correlate"}};

}  // namespace

constinit const JobCheck axes_open{"axes_open", CheckedAt::cut, Weight::reserves, of_open,
                                   find_open_axes};
constinit const JobCheck undiagnosed_correlated{"undiagnosed_correlated", CheckedAt::references,
                                                Weight::reserves, of_correlated, find_undiagnosed};
constinit const JobCheck noise_over_stated{"noise_over_stated", CheckedAt::references,
                                           Weight::reserves, of_stated, find_noise_over_stated};
constinit const JobCheck bow_or_vibration{
    "bow_or_vibration", CheckedAt::references, Weight::reserves, {}, find_bow};
constinit const JobCheck improbable_and_far{"improbable_and_far", CheckedAt::tolerance,
                                            Weight::leaves_open, of_improbable, find_improbable};

Reasons open_axes(const PlannedJob& result) {
  Reasons list;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || !result.job.target) continue;
    const FitResult& used = fit_used(result, i);
    const Reasons open = open_causes(*result.diagnoses[i]);
    if (&used == &result.fits[i] || open.empty()) continue;
    double moved_mm = 0.0, U_mm = 0.0;
    if (used.surface == SurfaceKind::plane) {  // what its tilt makes at the outer end
      const Axis &now = used.axis.axis, &ideal = result.fits[i].axis.axis;
      const double end_mm = std::max(std::abs(used.position_min_mm), used.position_max_mm);
      moved_mm = end_mm * std::hypot(now.slope_x - ideal.slope_x, now.slope_y - ideal.slope_y);
      U_mm = used.coverage_factor * end_mm * used.axis.u_slopes();
    }
    for (const double z_mm : {result.job.target->z_start_mm, result.job.target->z_end_mm}) {
      if (used.surface == SurfaceKind::plane) break;
      const auto [x, y] = used.axis.axis.at(z_mm);
      const auto [x_ideal, y_ideal] = result.fits[i].axis.axis.at(z_mm);
      moved_mm = std::max(moved_mm, std::hypot(x - x_ideal, y - y_ideal));
      U_mm = std::max(U_mm, used.coverage_factor * used.axis.u_at(z_mm));
    }
    if (moved_mm <= U_mm) continue;
    list.push_back({ReasonCode::axis_open, {i}, {{"moved", moved_mm, "mm", U_mm}}, {}, open});
  }
  return list;
}

}  // namespace trueaxis
