// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/clamping.hpp"

#include <algorithm>
#include <cmath>

#include "math/statistics.hpp"

namespace trueaxis::diagnose_detail {

bool is_diagnosable(const FitResult& fit) {
  const bool has_terms = fit.surface == SurfaceKind::cone || fit.surface == SurfaceKind::cylinder ||
                         fit.surface == SurfaceKind::section;
  return has_terms && !fit.set_ups.empty() && !fit.residual_mm.empty() &&
         (fit.status == FitStatus::converged || fit.status == FitStatus::rank_deficient) &&
         std::ranges::all_of(fit.residual_mm, [](double r) { return std::isfinite(r); });
}

std::vector<Clamping> clampings_of(const FitResult& fit, double ball_mm) {
  std::vector<Clamping> out;
  const SetUp* before = nullptr;
  for (const SetUpFit& s : fit.set_ups) {
    Clamping c;
    c.number = s.set_up.number;
    c.shape = s.shape;
    const double secant = std::hypot(1.0, s.shape.tan_half_angle);
    c.shape.radius_mm += (fit.bore ? -ball_mm : ball_mm) * secant;
    c.root = s.side;
    c.reindex_rad = s.set_up.reindex_rad;
    c.z_shift_mm = s.set_up.z_shift_mm;
    c.x_jog_mm = s.set_up.x_jog_mm;
    c.clamp_force_ratio = s.set_up.clamp_force_ratio;
    c.axis = out.empty() ? 0 : out.back().axis + (s.set_up.clamped_as(*before) ? 0 : 1);
    before = &s.set_up;
    out.push_back(c);
  }
  return out;
}

BaseKind base_of(const ProbeStream& stream, const FitResult& fit,
                 const std::vector<Clamping>& clampings) {
  BaseKind base;
  base.tilts = fit.surface != SurfaceKind::section;
  base.tapers = fit.surface == SurfaceKind::cone;
  base.offset = stream.indication == Indication::relative;
  base.axes = clampings.back().axis + 1;
  return base;
}

std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point) {
  std::vector<double> out(point.size());
  for (std::size_t i = 0; i < point.size(); ++i) out[i] = stream.reading_mm[i] - point.x[i];
  if (!point.base.offset) return out;
  const double zero = median(out);
  for (double& d : out) d -= zero;
  return out;
}

}  // namespace trueaxis::diagnose_detail
