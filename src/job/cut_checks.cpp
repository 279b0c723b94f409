// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/describe.hpp"
#include "job/beyond_probed.hpp"
#include "job/checks.hpp"
#include "job/material.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

double ball_of(const PlannedJob& result, std::size_t i) {
  const double said_mm = result.job.references[i].fit.ball_radius_mm;
  return said_mm > 0.0 ? said_mm : result.streams[i].ball_radius_mm.value_or(0.0);
}

/// A surface whose radius is not positive once the ball is subtracted.
std::optional<Reason> no_surface_behind_ball(const PlannedJob& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  if (fit.surface == SurfaceKind::plane || fit.surface == SurfaceKind::own) return {};
  for (const double z_mm : {fit.position_min_mm, fit.position_max_mm}) {
    const double radius_mm =
        fit.shape.radius_mm + fit.shape.tan_half_angle * (z_mm - fit.shape.axis.z_ref_mm);
    if (!(radius_mm > radius_U_mm(fit)))
      return Reason{
          ReasonCode::no_surface_behind_ball,
          {i},
          {{"ball", ball_of(result, i), "mm"}, {"radius", radius_mm, "mm"}, {"z", z_mm, "mm"}}};
  }
  return {};
}

/// What is met at a place, "Z = 12 mm, C = 90°".
Reason met_at(const Place& place, bool face, std::size_t i, ReasonCode code) {
  return {code,
          {i},
          {{"at", place.position_mm, "mm"},
           {"c", place.c_rad, "rad"},
           {"material", place.material_mm, "mm", place.U_mm}},
          {{"along", face ? "X" : "Z"}}};
}

/// A shaft to be cut in the hollow of a bore, or a bore outside of a shaft.
std::optional<Reason> no_material_between(const PlannedJob& result, std::size_t i) {
  const bool bore = result.job.target->bore;
  const std::optional<MaterialMet> wall = material_over(result, i);
  if (!wall || result.fits[i].bore == bore || wall->least.material_mm > wall->least.U_mm) return {};
  Reason reason = met_at(wall->least, false, i, ReasonCode::no_material_between);
  reason.names.push_back({"target", bore ? "bore" : "shaft"});
  reason.names.push_back({"probed", bore ? "shaft" : "bore"});
  return reason;
}

std::optional<Reason> not_the_stock(const PlannedJob& result, std::size_t i) {
  const std::optional<MaterialMet> over = material_over(result, i);
  const bool face = result.job.target->kind == TargetKind::face;
  if (!over || (!face && result.fits[i].bore != result.job.target->bore)) return {};
  if (const Place& least = over->least; least.material_mm < least.U_mm)
    return met_at(least, face, i,
                  least.material_mm < -least.U_mm ? ReasonCode::cuts_air : ReasonCode::may_cut_air);
  const Place& most = over->most;
  if (!result.job.stock_mm || !(most.material_mm + most.U_mm > *result.job.stock_mm)) return {};
  Reason reason = met_at(most, face, i, ReasonCode::stock_exceeded);
  reason.numbers.push_back({"stock", *result.job.stock_mm, "mm"});
  return reason;
}

/// For the first reference, and only if a cut is planned.
template <auto of_reference>
Reasons find_met(const CheckInput& in) {
  if (!in.job.correction) return {};
  return first_of_references(in.job, [&](std::size_t i) { return of_reference(in.job, i); });
}

Reasons find_ball(const CheckInput& in) {
  return first_of_references(in.job,
                             [&](std::size_t i) { return no_surface_behind_ball(in.job, i); });
}

Reasons find_refused(const CheckInput& in) {
  if (in.job.refused.empty()) return {};
  return {{ReasonCode::cut_refused, {}, {}, {{"why", in.job.refused}}}};
}

Reasons find_too_far(const CheckInput& in) {
  if (!in.job.correction) return {};
  auto far = extrapolation(in.job, refused_u_factor.value, ReasonCode::cut_too_far);
  if (!far) return {};
  far->remedies = {common_datum(in.job).value_or(Reason{ReasonCode::probe_nearer})};
  return {*far};
}

Reasons find_far(const CheckInput& in) {
  if (!in.job.correction) return {};
  auto far = extrapolation(in.job, reserved_u_factor.value, ReasonCode::cut_far);
  if (!far) return {};
  if (const auto common = common_datum(in.job)) far->remedies = {*common};
  return {*far};
}

Reasons find_relative(const CheckInput& in) {
  Reasons found;
  for (std::size_t i = 0; i < in.job.fits.size() && in.job.correction; ++i)
    if (in.job.streams[i].indication == Indication::relative)
      found.push_back({ReasonCode::gauge_shows_no_radius, {i}});
  return found;
}

constexpr Threshold of_radius[] = {{"radius", 1.0, "of its U", "less may be no surface at all"}};
constexpr Threshold of_material[] = {{"material", 1.0, "of its U", "less may be air"}};
constexpr Threshold of_refused[] = {refused_u_factor}, of_reserved[] = {reserved_u_factor};

}  // namespace

constinit const JobCheck cut_refused{
    "cut_refused", CheckedAt::cut, Weight::forbids, {}, find_refused};
constinit const JobCheck surface_behind_ball{"surface_behind_ball", CheckedAt::cut, Weight::forbids,
                                             of_radius, find_ball};
constinit const JobCheck material_between{"material_between", CheckedAt::cut, Weight::forbids,
                                          of_material, find_met<no_material_between>};
constinit const JobCheck stock{"stock", CheckedAt::cut, Weight::forbids, of_material,
                               find_met<not_the_stock>};
constinit const JobCheck cut_too_far{"cut_too_far", CheckedAt::cut, Weight::forbids, of_refused,
                                     find_too_far};
constinit const JobCheck cut_far{"cut_far", CheckedAt::cut, Weight::reserves, of_reserved,
                                 find_far};
constinit const JobCheck gauge_shows_no_radius{
    "gauge_shows_no_radius", CheckedAt::cut, Weight::reserves, {}, find_relative};

void require_stock(const PlannedJob& result) {
  if (!result.job.target || result.job.stock_mm) return;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const bool face = result.job.target->kind == TargetKind::face;
    const auto over = overlap_mm(result, i);
    if (!over || (!face && result.fits[i].bore != result.job.target->bore)) continue;
    throw InputError(
        "", fmt::format("[target] stock_um is missing: from {} = {:.6g} to {:.6g} mm the target "
                        "lies on the probed surface of {}: state how much may be removed there, {}",
                        face ? "X" : "Z", over->first, over->second, result.job.references[i].name,
                        face ? "along Z" : "in radius"));
  }
}

}  // namespace trueaxis
