// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "trueaxis/surface.hpp"

namespace trueaxis {
namespace {

struct Vec3 {
  double x, y, z;
};
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 fma(double scale, const Vec3& a, const Vec3& b) {
  return {scale * a.x + b.x, scale * a.y + b.y, scale * a.z + b.z};
}

AxisRow slope_of(AxisRow i) { return i == AxisRow::x ? AxisRow::slope_x : AxisRow::slope_y; }

/// Root of the larger eigenvalue of [[xx, xy], [xy, yy]].
double worse_u(double xx, double xy, double yy) {
  const double largest = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return std::sqrt(std::max(largest, 0.0));  // in this order NaN stays NaN: no u is not u = 0
}

}  // namespace

double AxisEstimate::u_at(double z_mm) const {
  const double lever = z_mm - axis.z_ref_mm;
  // Covariance of (x + lever·slope_x, y + lever·slope_y).
  const auto propagated = [&](AxisRow i, AxisRow j) {
    const AxisRow si = slope_of(i), sj = slope_of(j);
    return covariance(i, j) + lever * (covariance(i, sj) + covariance(si, j)) +
           lever * lever * covariance(si, sj);
  };
  using enum AxisRow;
  return worse_u(propagated(x, x), 0.5 * (propagated(x, y) + propagated(y, x)), propagated(y, y));
}

double AxisEstimate::u_slope() const {
  using enum AxisRow;
  return worse_u(covariance(slope_x, slope_x), covariance(slope_x, slope_y),
                 covariance(slope_y, slope_y));
}

double AxisEstimate::u_tilt() const {
  using enum AxisRow;
  const double a = axis.slope_x, b = axis.slope_y, size = std::hypot(a, b), worst = u_slope();
  if (!(size > worst)) return worst;
  return std::sqrt(a * a * covariance(slope_x, slope_x) +
                   2.0 * a * b * covariance(slope_x, slope_y) +
                   b * b * covariance(slope_y, slope_y)) /
         size;
}

double AxisEstimate::u_slopes() const {
  using enum AxisRow;
  return std::sqrt(covariance(slope_x, slope_x) + covariance(slope_y, slope_y));
}

// The origin of the vectors is the axis point at height z rather than at z_ref: all lengths are
// then of the size of the section, and nothing is lost far from z_ref.
Intersection intersect(const Revolved& surface, double c_rad, double z_mm, double height_mm,
                       Root root) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Axis& axis = surface.axis;
  const double t = surface.tan_half_angle;
  const double cos_c = std::cos(c_rad), sin_c = std::sin(c_rad);
  const double secant = std::sqrt(1.0 + axis.slope_x * axis.slope_x + axis.slope_y * axis.slope_y);
  const Vec3 d{axis.slope_x / secant, axis.slope_y / secant, 1.0 / secant};
  const Vec3 e{cos_c, sin_c, 0.0};
  const auto [x_axis, y_axis] = axis.at(z_mm);
  const double radius_z = surface.radius_mm + t * (z_mm - axis.z_ref_mm) * secant;

  const Vec3 q0{-height_mm * sin_c - x_axis, height_mm * cos_c - y_axis, 0.0};
  const double s0 = dot(q0, d), g = dot(e, d), r0 = radius_z + t * s0;
  const Vec3 across = fma(-s0, d, q0);
  const double distance = std::sqrt(dot(across, across));

  // Eq. 7: a X² + 2 b X + c = 0 with γ = 0.
  const double a = 1.0 - g * g * (1.0 + t * t);
  const double b = dot(e, across) - g * t * r0;
  const double c = (distance - r0) * (distance + r0);
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) return {none, none, none, false};
  const double stable = -(b + std::copysign(std::sqrt(discriminant), b));

  double x = none;
  for (const double candidate : {stable / a, c / stable}) {
    if (!std::isfinite(candidate) || r0 + t * g * candidate <= 0.0) continue;  // mirrored nappe
    const bool better = root == Root::front ? candidate > x : candidate < x;
    if (std::isnan(x) || better) x = candidate;
  }
  if (std::isnan(x)) return {none, none, none, false};

  // G: half the gradient of |q|² − s² − r² at the contact.
  const Vec3 q = fma(x, e, q0);
  const double s = s0 + g * x, r = r0 + t * g * x;
  const Vec3 gradient = fma(-(s + t * r), d, q);
  const double along = dot(e, gradient);
  const Vec3 turned{-x * sin_c - height_mm * cos_c, x * cos_c - height_mm * sin_c, 0.0};  // ∂p/∂C
  return {x, -gradient.z / along, -dot(gradient, turned) / along, true};
}

}  // namespace trueaxis
