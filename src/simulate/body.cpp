// SPDX-License-Identifier: Apache-2.0
#include "simulate/body.hpp"

#include <algorithm>
#include <limits>

#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {

Span make_span(const Scenario& scenario) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlannedPass& pass : scenario.plan.passes) {
    low = std::min({low, pass.start_mm, pass.end_mm});
    high = std::max({high, pass.start_mm, pass.end_mm});
  }
  return {scenario.u_start_mm.value_or(low), scenario.u_end_mm.value_or(high)};
}

RigidFrame part_frame(const Part& part, const Chucking& setup) {
  const Vec3 origin{setup.x0_mm.value_or(part.x0_mm), setup.y0_mm.value_or(part.y0_mm),
                    setup.z_shift_mm};
  return RigidFrame::about(origin, setup.l.value_or(part.l), setup.m.value_or(part.m));
}

Body::Body(const Scenario& scenario, const Chain& chain)
    : chain_(chain), span_(make_span(scenario)), face_(scenario.part.kind == PartKind::face) {
  const Part& part = scenario.part;
  deformed_ = !chain.form.empty() || !chain.bend.empty();
  outward_ = part.bore ? -1.0 : 1.0;
  if (face_) {
    level_mm_ = part.d_mm - part.l * part.x0_mm - part.m * part.y0_mm;
    return;
  }
  if (part.kind == PartKind::cylinder) {
    radius_mm_ = part.radius_mm;
    return;
  }
  tangent_ = std::tan(part.half_angle_rad);
  secant_ = std::sqrt(1.0 + tangent_ * tangent_);
  if (part.apex_mm) {
    const double low = std::min(span_.start_mm, span_.end_mm);
    const double high = std::max(span_.start_mm, span_.end_mm);
    if (*part.apex_mm >= low && *part.apex_mm <= high) {
      throw InputError("scenario", "the cone's apex lies inside the probed length: move it out");
    }
    if (*part.apex_mm > high) tangent_ = -tangent_;
    radius_mm_ = -tangent_ * *part.apex_mm;
  } else {
    radius_mm_ = part.radius_mm - tangent_ * part.radius_at_mm;
  }
}

double Body::gap(const Vec3& in_part, const Chucking& setup) const {
  Vec3 p = in_part;
  // The part turned in the sense of C, as the spindle turns it, so that a mark is at less C.
  if (!chain_.bend.empty()) {
    const double cosine = std::cos(setup.reindex_rad), sine = -std::sin(setup.reindex_rad);
    for (const auto& bend : chain_.bend) {
      const Vec3 away = bend(in_part.z);
      p = p - Vec3{away.x * cosine - away.y * sine, away.x * sine + away.y * cosine, away.z};
    }
  }
  double form = 0.0;
  if (!chain_.form.empty()) {
    SurfacePoint point;
    point.chuck_theta_rad = std::atan2(p.y, p.x);
    point.theta_rad = point.chuck_theta_rad + setup.reindex_rad;
    point.s_mm = face_ ? std::hypot(p.x, p.y) : p.z;
    point.u = span_.u(point.s_mm);
    point.u_half_mm = 0.5 * std::abs(span_.end_mm - span_.start_mm);
    point.clamp = setup.clamp_force_ratio;
    point.outward = outward_;
    for (const auto& term : chain_.form) form += term(point);
  }
  return ideal_gap(p) - secant_ * form;
}

}  // namespace trueaxis::virtual_lathe
