// SPDX-License-Identifier: Apache-2.0
#include "job/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "measure/feature.hpp"
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

Reasons if_a_cone() { return {{ReasonCode::set_surface, {}, {}, {{"surface", "cone"}}}}; }

}  // namespace

SurfaceEvidence surface_by_evidence(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face) return {SurfaceKind::plane, {ReasonCode::reads_a_face}};
  if (!(length_mm(stream) > 0.0)) return {SurfaceKind::section, {ReasonCode::no_change_of_z}};
  FitOptions options;
  options.surface = SurfaceKind::cone;
  options.bore = states_bore(stream);
  const FitResult cone = fit(stream, options);
  if (cone.status == FitStatus::implausible) return {SurfaceKind::cone, {ReasonCode::cone_at_last}};
  if (cone.status != FitStatus::converged)
    return {SurfaceKind::cylinder, {ReasonCode::no_taper_seen, {}, {}, {}, {}, if_a_cone()}};
  const Estimate& half_angle = cone.parameter("half_angle");
  const double taper = std::abs(cone.shape.tan_half_angle);
  const bool tapers = taper > least_taper && half_angle.determined() &&
                      std::abs(half_angle.value) > sure * half_angle.u;
  const SurfaceKind surface = tapers ? SurfaceKind::cone : SurfaceKind::cylinder;
  const double length = length_mm(stream);
  Reason why{ReasonCode::taper_seen, {}, {}, {{"surface", to_string(surface)}}};
  if (half_angle.determined() && std::isfinite(half_angle.u))
    why.numbers = {{"half_angle", std::abs(half_angle.value), "rad",
                    half_angle.expanded(cone.coverage_factor)}};
  else
    why.numbers = {{"change", taper * length, "mm"}, {"length", length, "mm"}};
  if (!tapers) why.remedies = if_a_cone();
  return {surface, std::move(why)};
}

}  // namespace trueaxis
