// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulate/chain.hpp"
#include "simulate/geometry.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// Where −1 and +1 of u lie.
struct Span {
  double start_mm = 0.0, end_mm = 0.0;
  double u(double position_mm) const {
    const double length = end_mm - start_mm;
    return length == 0.0 ? 0.0 : (2.0 * position_mm - start_mm - end_mm) / length;
  }
};

/// The extremes of the plan, or what the scenario says.
Span make_span(const Scenario& scenario);

/// The part's surface in its own frame: gap > 0 off it on the far side of the axis (face: above).
/// Cone and cylinder: gap = √(x² + y²) − r(s) − ρ(θ, s)/cos α, r(s) = radius_mm + tangent s.
/// Beyond an apex r is negative: there is no mirrored nappe.
class Body {
 public:
  Body(const Scenario& scenario, const Chain& chain);

  /// Without form and bend.
  double ideal_gap(const Vec3& p) const {
    if (face_) return p.z - level_mm_;
    return std::sqrt(p.x * p.x + p.y * p.y) - radius_mm_ - tangent_ * p.z;
  }
  /// With them; the part is in `setup`.
  double gap(const Vec3& p, const Chucking& setup) const;

  bool deformed() const { return deformed_; }
  bool face() const { return face_; }
  double radius_at(double s_mm) const { return radius_mm_ + tangent_ * s_mm; }
  double level_mm() const { return level_mm_; }

 private:
  const Chain& chain_;
  Span span_;
  bool face_ = false, deformed_ = false;
  double outward_ = 1.0;
  double radius_mm_ = 0.0, tangent_ = 0.0, secant_ = 1.0, level_mm_ = 0.0;
};

/// Frame of the part in a set-up.
RigidFrame part_frame(const Part& part, const Chucking& setup);

}  // namespace trueaxis::virtual_lathe
