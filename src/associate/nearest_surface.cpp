// SPDX-License-Identifier: Apache-2.0
#include "associate/nearest_surface.hpp"

#include <cmath>

namespace trueaxis {
namespace {

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point3 plus(const Point3& a, double by, const Point3& b) {
  return {a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]};
}
Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double norm(const Point3& a) { return std::hypot(a[0], a[1], a[2]); }
Point3 unit(const Point3& a) {
  const double length = norm(a);
  return length > 0.0 ? Point3{a[0] / length, a[1] / length, a[2] / length} : Point3{};
}

}  // namespace

NearestSurface nearest_surface(const AssociatedFeature& associated, const Point3& point) {
  const Feature& f = associated.feature;
  NearestSurface out;
  out.arm_mm = plus(point, -1.0, f.point_mm);
  if (associated.element == Element::sphere) {
    out.normal = unit(out.arm_mm);
    out.distance_mm = norm(out.arm_mm) - f.radius_mm;
    return out;
  }
  const double height = dot(out.arm_mm, f.direction);
  const Point3 across = plus(out.arm_mm, -height, f.direction), away = unit(across);
  const double rho = norm(across);
  // A circle's size is seen along its axis, but for the zone of one in space.
  const bool flat_circle = associated.in_plane ||
                           associated.criterion == Criterion::minimum_circumscribed ||
                           associated.criterion == Criterion::maximum_inscribed;
  const auto tube = [&](double minor) {
    const Point3 from = plus(out.arm_mm, -f.radius_mm, away);
    out.normal = unit(from);
    out.distance_mm = norm(from) - minor;
  };
  switch (associated.element) {
    case Element::line:
      out.normal = associated.in_plane ? cross({0.0, 0.0, 1.0}, f.direction) : away;
      out.distance_mm = associated.in_plane ? dot(out.arm_mm, out.normal) : rho;
      break;
    case Element::plane:
      out.normal = f.direction;
      out.distance_mm = height;
      break;
    case Element::circle:
      out.normal = away;
      out.distance_mm = rho - f.radius_mm;
      if (!flat_circle) tube(0.0);
      break;
    case Element::cylinder:
      out.normal = away;
      out.distance_mm = rho - f.radius_mm;
      break;
    case Element::cone: {
      const double c = std::cos(f.half_angle_rad), s = std::sin(f.half_angle_rad);
      out.normal = plus({c * away[0], c * away[1], c * away[2]}, -s, f.direction);
      out.distance_mm = (rho - f.radius_mm) * c - height * s;
      break;
    }
    case Element::torus:
      tube(f.minor_radius_mm);
      break;
    case Element::sphere:
      break;
  }
  return out;
}

Balance balance_of(const AssociatedFeature& associated, std::span<const Point3> points_mm) {
  Balance out;
  const Feature& f = associated.feature;
  for (const AssociationCertificate::Contact& contact : associated.certificate.contacts) {
    const NearestSurface at = nearest_surface(associated, points_mm[contact.point]);
    const double weight = contact.multiplier * contact.sign;
    out.force = plus(out.force, weight, at.normal);
    out.moment_mm = plus(out.moment_mm, weight, cross(at.arm_mm, at.normal));
    out.size += weight;
    const double height = dot(at.arm_mm, f.direction);
    const Point3 across = plus(at.arm_mm, -height, f.direction);
    if (associated.element == Element::cone)  // along the generatrix, from the radius at the point
      out.second_size += weight * ((norm(across) - f.radius_mm) * std::sin(f.half_angle_rad) +
                                   height * std::cos(f.half_angle_rad));
    if (associated.element == Element::torus || associated.element == Element::circle)
      out.second_size += weight * dot(at.normal, unit(across));
  }
  return out;
}

std::vector<double> distances_mm(std::span<const Point3> points_mm,
                                 const AssociatedFeature& associated) {
  std::vector<double> out;
  out.reserve(points_mm.size());
  for (const Point3& point : points_mm)
    out.push_back(nearest_surface(associated, point).distance_mm);
  return out;
}

}  // namespace trueaxis
