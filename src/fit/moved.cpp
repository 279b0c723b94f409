// SPDX-License-Identifier: Apache-2.0
#include "fit/moved.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis {
double U_of_axis_mm(const FitResult& fit) {
  const double outer_mm = std::max(std::abs(fit.position_min_mm), std::abs(fit.position_max_mm));
  const double u_mm =
      fit.surface == SurfaceKind::plane
          ? outer_mm * fit.axis.u_slopes()
          : std::max(fit.axis.u_at(fit.position_min_mm), fit.axis.u_at(fit.position_max_mm));
  return fit.coverage_factor * u_mm;
}

std::optional<CentreStep> moved_in_pass(const ProbeStream& stream, std::span<const double> left_mm,
                                        const FitResult& fit, double by_chance) {
  if (!fit.axis_known() || left_mm.size() != stream.size()) return {};
  const auto step =
      find_centre_step(turn_centres(stream, left_mm, CentresOf::residuals), by_chance);
  if (!step || !(step->size_mm > U_of_axis_mm(fit))) return {};
  return weighed_with_delay(*step, stream, stream.reading_mm);
}

}  // namespace trueaxis
