// SPDX-License-Identifier: Apache-2.0
#include "job/cut_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/describe.hpp"
#include "job/beyond_probed.hpp"
#include "job/material.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

double ball_of(const JobResult& result, std::size_t i) {
  const double said_mm = result.job.references[i].fit.ball_radius_mm;
  return said_mm > 0.0 ? said_mm : result.streams[i].ball_radius_mm.value_or(0.0);
}

/// A surface whose radius, once the ball is taken off, is none.
std::string ball_objection(const JobResult& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  if (fit.surface == SurfaceKind::plane || fit.surface == SurfaceKind::own) return "";
  for (const double z_mm : {fit.position_min_mm, fit.position_max_mm}) {
    const double radius_mm =
        fit.shape.radius_mm + fit.shape.tan_half_angle * (z_mm - fit.shape.axis.z_ref_mm);
    if (radius_mm > radius_U_mm(fit)) continue;
    return fmt::format(
        "{}: with a ball of radius {:.6g} mm the surface has a radius of {:.6g} mm at Z = {:.6g} "
        "mm: give the radius of the probe's ball, or none where the readings are of the contact",
        result.job.references[i].name, ball_of(result, i), radius_mm, z_mm);
  }
  return "";
}

/// "Z = 12 mm, C = 90°"
std::string at_place(const Place& place, bool face) {
  return fmt::format("{} = {:.6g} mm, C = {:.4g}°", face ? "X" : "Z", place.position_mm,
                     place.c_rad / rad_per_deg);
}

/// "12.3 µm" or "1.25 mm"
std::string readable(double length_mm) {
  return std::abs(length_mm) < 1.0 ? fmt::format("{:.4g} µm", length_mm / mm_per_um)
                                   : fmt::format("{:.4g} mm", length_mm);
}

/// A shaft to be cut in the hollow of a bore, or a bore outside of a shaft.
std::string hollow_objection(const JobResult& result, std::size_t i) {
  const bool bore = result.job.target->bore;
  const std::optional<MaterialMet> wall = material_over(result, i);
  if (!wall || result.fits[i].bore == bore || wall->least.material_mm > wall->least.U_mm) return "";
  return fmt::format(
      "the target is a {} and the probed surface of {} a {}: at {} there is no material between "
      "them ({}): see which feature is a shaft and which a bore",
      bore ? "bore" : "shaft", result.job.references[i].name, bore ? "shaft" : "bore",
      at_place(wall->least, false), readable(wall->least.material_mm));
}

std::string stock_objection(const JobResult& result, std::size_t i) {
  const std::optional<MaterialMet> over = material_over(result, i);
  const bool face = result.job.target->kind == TargetKind::face;
  if (!over || (!face && result.fits[i].bore != result.job.target->bore)) return "";
  const std::string& name = result.job.references[i].name;
  if (const Place& least = over->least; least.material_mm < least.U_mm) {
    return fmt::format("the target {} air: at {} the probed surface of {} has {} over it (U = {})",
                       least.material_mm < -least.U_mm ? "cuts" : "may cut", at_place(least, face),
                       name, readable(least.material_mm), readable(least.U_mm));
  }
  const Place& most = over->most;
  if (result.job.stock_mm && most.material_mm + most.U_mm > *result.job.stock_mm) {
    return fmt::format(
        "the target needs more than the stated stock of {}: at {} the probed surface of {} has {} "
        "over it (U = {})",
        readable(*result.job.stock_mm), at_place(most, face), name, readable(most.material_mm),
        readable(most.U_mm));
  }
  return "";
}

}  // namespace

void require_stock(const JobResult& result) {
  if (!result.job.target || result.job.stock_mm) return;
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const bool face = result.job.target->kind == TargetKind::face;
    const auto over = overlap_mm(result, i);
    if (!over || (!face && result.fits[i].bore != result.job.target->bore)) continue;
    throw InputError(
        result.job.path,
        fmt::format("[target] stock_um is missing: from {} = {:.6g} to {:.6g} mm the target lies "
                    "on the probed surface of {}: say how much may be removed there, {}",
                    face ? "X" : "Z", over->first, over->second, result.job.references[i].name,
                    face ? "along Z" : "in radius"));
  }
}

std::string cut_objection(const JobResult& result) {
  const auto first_of = [&](auto check) {
    std::string why;
    for (std::size_t i = 0; i < result.fits.size() && why.empty(); ++i) why = check(result, i);
    return why;
  };
  if (std::string why = first_of(ball_objection); !why.empty()) return why;
  if (!result.correction) return "";
  if (std::string why = first_of(hollow_objection); !why.empty()) return why;
  if (std::string why = first_of(stock_objection); !why.empty()) return why;
  const std::string far = extrapolation(result, refused_u_factor);
  if (far.empty()) return "";
  const std::string common = common_datum(result);
  return far + ": " + (common.empty() ? "probe nearer to it, or a greater length" : common);
}

std::vector<std::string> cut_reservations(const JobResult& result) {
  std::vector<std::string> sentences;
  if (!result.correction) return sentences;
  if (std::string far = extrapolation(result, reserved_u_factor); !far.empty()) {
    const std::string common = common_datum(result);
    sentences.push_back(far + (common.empty() ? "" : "; " + common));
  }
  for (std::size_t i = 0; i < result.fits.size(); ++i)
    if (result.streams[i].indication == Indication::relative)
      sentences.push_back(result.job.references[i].name +
                          " was read with a relative gauge, which shows no radius: whether the "
                          "target cuts air there is not known");
  return sentences;
}

}  // namespace trueaxis
