// SPDX-License-Identifier: Apache-2.0
#include "job/material.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr int places = 21, angles = 72;

double or_zero(double u) { return std::isfinite(u) ? u : 0.0; }

bool faces(const PlannedJob& result, std::size_t i) {
  return result.job.target->kind == TargetKind::face &&
         result.fits[i].surface == SurfaceKind::plane;
}

/// Standard uncertainty of the fitted radius, mm.
double u_radius_mm(const FitResult& fit) {
  return or_zero(fit.parameter(fit.surface == SurfaceKind::cone ? "radius_mid" : "radius").u);
}

/// For a shaft or bore at (C, Z): outwards from the target to the probed surface.
Place between_revolved(const FitResult& fit, const Revolved& target, double c_rad, double z_mm) {
  const Intersection probed = intersect(fit.shape, c_rad, z_mm),
                     wanted = intersect(target, c_rad, z_mm);
  return {z_mm, c_rad, probed.x_mm - wanted.x_mm,
          fit.coverage_factor * std::hypot(or_zero(fit.axis.u_at(z_mm)), u_radius_mm(fit))};
}

/// For a face at (C, X): along Z from the target to the probed plane.
Place between_faces(const FitResult& fit, const Axis& axis, double z_face_mm, double c_rad,
                    double x_mm) {
  const Axis& normal = fit.axis.axis;
  const double x = x_mm * std::cos(c_rad), y = x_mm * std::sin(c_rad);
  const double n =
      1.0 / std::sqrt(1.0 + normal.slope_x * normal.slope_x + normal.slope_y * normal.slope_y);
  const auto [ax, ay] = axis.at(z_face_mm);
  const Estimate& d = fit.parameter("d");
  const double probed = d.value / n - normal.slope_x * x - normal.slope_y * y;
  const double wanted = z_face_mm - axis.slope_x * (x - ax) - axis.slope_y * (y - ay);
  return {x_mm, c_rad, probed - wanted,
          fit.coverage_factor * std::hypot(or_zero(d.u), x_mm * or_zero(fit.axis.u_slope()))};
}

}  // namespace

std::optional<std::pair<double, double>> overlap_mm(const PlannedJob& result, std::size_t i) {
  const FitResult& fit = result.fits[i];
  const TargetSurface& target = *result.job.target;
  const bool face = target.kind == TargetKind::face;
  if (fit.status != FitStatus::converged || result.streams[i].indication == Indication::relative ||
      fit.surface == SurfaceKind::own || face != (fit.surface == SurfaceKind::plane))
    return std::nullopt;
  const auto [low, high] = std::minmax({target.path_start_mm(), target.path_end_mm()});
  // A face is probed at X < 0 as well: its radii, and those of the target, are |X|.
  const double nearest =
      face && fit.position_max_mm < 0.0 ? -fit.position_max_mm : fit.position_min_mm;
  const double farthest =
      face ? std::max(-fit.position_min_mm, fit.position_max_mm) : fit.position_max_mm;
  const double from = std::max(low, nearest), to = std::min(high, farthest);
  return from < to ? std::optional(std::pair(from, to)) : std::nullopt;
}

std::optional<MaterialMet> material_over(const PlannedJob& result, std::size_t i) {
  const auto over = overlap_mm(result, i);
  if (!over || !result.target_axis) return std::nullopt;
  const TargetSurface& target = *result.job.target;
  const FitResult& fit = fit_used(result, i);
  const Axis& axis = result.target_axis->axis.axis;
  const auto [x, y] = axis.at(target.z_start_mm);
  const Revolved wanted{{x, y, axis.slope_x, axis.slope_y, target.z_start_mm},
                        target.radius_mm,
                        target.tan_half_angle};
  std::optional<MaterialMet> found;
  for (int p = 0; p < places; ++p) {
    const double at = over->first + (over->second - over->first) * p / (places - 1);
    for (int a = 0; a < angles; ++a) {
      const double c_rad = two_pi * a / angles;
      Place place = faces(result, i) ? between_faces(fit, axis, target.z_face_mm, c_rad, at)
                                     : between_revolved(fit, wanted, c_rad, at);
      if (fit.bore) place.material_mm = -place.material_mm;
      if (!found) found = MaterialMet{place, place};
      if (place.material_mm - place.U_mm < found->least.material_mm - found->least.U_mm)
        found->least = place;
      if (place.material_mm + place.U_mm > found->most.material_mm + found->most.U_mm)
        found->most = place;
    }
  }
  return found;
}

}  // namespace trueaxis
