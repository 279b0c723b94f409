// SPDX-License-Identifier: Apache-2.0
#include "job/evidence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

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

}  // namespace

SurfaceEvidence surface_by_evidence(const ProbeStream& stream) {
  if (stream.kind == StreamKind::face)
    return {SurfaceKind::plane, "taken for a plane: Z_M is read at C and X"};
  if (!(length_mm(stream) > 0.0))
    return {SurfaceKind::section, "taken for one section: there is no change of Z"};
  FitOptions options;
  options.surface = SurfaceKind::cone;
  const FitResult cone = fit(stream, options);
  if (cone.status == FitStatus::implausible) return {SurfaceKind::cone, "taken for a cone"};
  if (cone.status != FitStatus::converged)
    return {SurfaceKind::cylinder,
            "taken for a cylinder: no taper is seen; say --surface cone if it is one"};
  const Estimate& half_angle = cone.parameter("half_angle");
  const double taper = std::abs(cone.shape.tan_half_angle);
  const bool tapers = taper > least_taper && half_angle.determined() &&
                      std::abs(half_angle.value) > sure * half_angle.u;
  const double change_um = taper * length_mm(stream) / mm_per_um;
  const std::string surface = tapers ? "cone" : "cylinder";
  std::string why = fmt::format("taken for a {}: ", surface);
  if (half_angle.determined() && std::isfinite(half_angle.u)) {
    const double U_deg = half_angle.expanded(cone.coverage_factor);
    const int decimals = decimals_of(U_deg, 0);
    why += fmt::format("half angle {:.{}f}° ± {:.{}f}°", std::abs(half_angle.value), decimals,
                       U_deg, decimals);
  } else {
    why += fmt::format("the radius changes by {:.4g} µm over {:.4g} mm of Z", change_um,
                       length_mm(stream));
  }
  if (!tapers) why += "; say --surface cone if it is one";
  return {tapers ? SurfaceKind::cone : SurfaceKind::cylinder, why};
}

}  // namespace trueaxis
