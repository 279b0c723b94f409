// SPDX-License-Identifier: Apache-2.0
#include "job/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "trueaxis/fit.hpp"

namespace trueaxis {
namespace {

constexpr double least_taper =
    1e-3;                     // of the radius over a length: 0.06°, a worn bed makes 0.1 of it
constexpr double sure = 3.0;  // u

double length_mm(const ProbeStream& stream) {
  if (!stream.has_position()) return 0.0;
  const auto [low, high] = std::ranges::minmax(stream.position_mm);
  return high - low;
}

/// A job takes no sphere, and a cylinder through one has an axis that leans anywhere.
std::optional<Reason> a_sphere(const ProbeStream& stream, const FitResult& cone) {
  constexpr double much_better = 0.1;  // of the residuals
  if (stream.indication == Indication::relative || list_set_ups(stream).size() > 1) return {};
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  const double rms_mm =
      cone.status == FitStatus::converged ? cone.rms_mm : fit(stream, options).rms_mm;
  options.surface = SurfaceKind::sphere;
  const FitResult sphere = fit(stream, options);
  if (sphere.status != FitStatus::converged || !(sphere.rms_mm < much_better * rms_mm)) return {};
  return Reason{ReasonCode::is_a_sphere,
                {},
                {{"radius", sphere.parameter("radius").value, "mm"}},
                {{"stream", stream.source}}};
}

Reasons if_a_cone() { return {{ReasonCode::set_surface, {}, {}, {{"surface", "cone"}}}}; }

}  // namespace

SurfaceEvidence surface_by_evidence(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face) return {SurfaceKind::plane, {ReasonCode::reads_a_face}};
  if (!(length_mm(stream) > 0.0)) return {SurfaceKind::section, {ReasonCode::no_change_of_z}};
  FitOptions options;
  options.surface = SurfaceKind::cone;
  const FitResult cone = fit(stream, options);
  if (auto sphere = a_sphere(stream, cone)) return {SurfaceKind::sphere, std::move(*sphere)};
  if (cone.status == FitStatus::implausible) return {SurfaceKind::cone, {ReasonCode::cone_at_last}};
  if (cone.status != FitStatus::converged)
    return {SurfaceKind::cylinder, {ReasonCode::no_taper_seen, {}, {}, {}, {}, if_a_cone()}};
  const Estimate& half_angle = cone.parameter("half_angle");
  const double taper = std::abs(cone.shape.tan_half_angle);
  const bool tapers = taper > least_taper && half_angle.determined() &&
                      std::abs(half_angle.value) > sure * half_angle.u;
  const SurfaceKind surface = tapers ? SurfaceKind::cone : SurfaceKind::cylinder;
  const double length = length_mm(stream);
  Reason why{ReasonCode::taper_seen,
             {},
             {{"change", taper * length, "mm"}, {"length", length, "mm"}},
             {{"surface", to_string(surface)}}};
  if (half_angle.determined() && std::isfinite(half_angle.u))
    why.numbers.push_back({"half_angle", std::abs(half_angle.value), "deg",
                           half_angle.expanded(cone.coverage_factor)});
  if (!tapers) why.remedies = if_a_cone();
  return {surface, std::move(why)};
}

}  // namespace trueaxis
