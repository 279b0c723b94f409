// SPDX-License-Identifier: Apache-2.0
#include "nc/arc.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trueaxis::nc {
namespace {

constexpr double pi = std::numbers::pi;
// What a program's rounded numbers may leave between the two radii of an arc.
constexpr double largest_radius_gap_mm = 0.01;
// More is a slip of a unit: a circle of 10 m takes 2e5 of them to within a nanometre.
constexpr double most_chords_of_arc = 1e6;

struct Point {
  double u = 0.0, v = 0.0;
};

/// The axes u, v of a plane: from u to v is the sense of G3.
struct PlaneAxes {
  std::size_t u, v;
};
constexpr PlaneAxes axes_of(Plane plane) {
  return plane == Plane::xy   ? PlaneAxes{0, 1}
         : plane == Plane::zx ? PlaneAxes{2, 0}
                              : PlaneAxes{1, 2};
}

/// Centre from the radius: on the left of the way from start to end where G3 turns less than half.
std::optional<Point> centre_by_radius(const Arc& arc, Point from, Point to) {
  const double radius_mm = *arc.radius_mm;
  const double du = to.u - from.u, dv = to.v - from.v, half = 0.5 * std::hypot(du, dv);
  if (half == 0.0 || half > std::abs(radius_mm) + largest_radius_gap_mm) return std::nullopt;
  const double height = std::sqrt(std::max(0.0, radius_mm * radius_mm - half * half));
  const double side = (arc.clockwise ? -1.0 : 1.0) * (radius_mm < 0.0 ? -1.0 : 1.0);
  return Point{from.u + 0.5 * du - side * height * dv / (2.0 * half),
               from.v + 0.5 * dv + side * height * du / (2.0 * half)};
}

std::optional<Point> centre_of(const Arc& arc, Point from, Point to, PlaneAxes plane,
                               std::string& trouble) {
  const auto &u = arc.centre_mm[plane.u], &v = arc.centre_mm[plane.v];
  if (arc.radius_mm && (u || v)) {
    trouble = "the arc has both R and a centre: keep one";
  } else if (arc.radius_mm) {
    if (auto centre = centre_by_radius(arc, from, to)) return centre;
    trouble = "R is less than half of the way between the arc's ends, or these are one point";
  } else if (u || v) {
    return Point{from.u + u.value_or(0.0), from.v + v.value_or(0.0)};
  } else {
    trouble = "the arc has neither R nor a centre in its plane (G17 I J, G18 I K, G19 J K)";
  }
  return std::nullopt;
}

}  // namespace

std::optional<ArcWay> ArcWay::of(const Arc& arc, double tolerance_mm, std::string& trouble) {
  const PlaneAxes plane = axes_of(arc.plane);
  const Point from{arc.from[plane.u], arc.from[plane.v]}, to{arc.to[plane.u], arc.to[plane.v]};
  const std::optional<Point> centre = centre_of(arc, from, to, plane, trouble);
  if (!centre) return std::nullopt;
  ArcWay way;
  way.from_ = arc.from, way.to_ = arc.to;
  way.u_ = plane.u, way.v_ = plane.v;
  way.centre_u_ = centre->u, way.centre_v_ = centre->v;
  way.from_radius_ = std::hypot(from.u - centre->u, from.v - centre->v);
  way.to_radius_ = std::hypot(to.u - centre->u, to.v - centre->v);
  if (std::abs(way.to_radius_ - way.from_radius_) > largest_radius_gap_mm ||
      way.from_radius_ == 0.0) {
    trouble = "the arc's ends are not at one distance from its centre: " +
              std::to_string(way.from_radius_) + " mm and " + std::to_string(way.to_radius_) +
              " mm";
    return std::nullopt;
  }
  way.start_rad_ = std::atan2(from.v - centre->v, from.u - centre->u);
  const double sense = arc.clockwise ? -1.0 : 1.0;
  double turn = sense * (std::atan2(to.v - centre->v, to.u - centre->u) - way.start_rad_);
  // A turn of nothing is a full circle.
  const double nothing = 1e-9;
  while (turn <= nothing) turn += 2.0 * pi;
  while (turn > 2.0 * pi + nothing) turn -= 2.0 * pi;
  way.turn_rad_ = sense * turn;
  // Height of a chord's arc over it: r (1 - cos(step / 2)) = 2 r sin²(step / 4).
  const double radius = std::max(way.from_radius_, way.to_radius_);
  const double sine = std::min(std::sqrt(0.5 * tolerance_mm / radius), std::sin(0.125 * pi));
  const double chords = std::max(1.0, std::ceil(turn / (4.0 * std::asin(sine)) - nothing));
  if (!(chords <= most_chords_of_arc)) {
    trouble = "the arc of radius " + std::to_string(radius) +
              " mm takes more than 1000000 chords at this tolerance: correct R or the centre, or "
              "raise the tolerance";
    return std::nullopt;
  }
  way.chords_ = static_cast<std::uint32_t>(chords);
  return way;
}

AxisValues ArcWay::after(double chords) const {
  const double s = chords / static_cast<double>(chords_);
  const double angle = start_rad_ + s * turn_rad_;
  const double radius = from_radius_ + s * (to_radius_ - from_radius_);
  AxisValues words;
  for (std::size_t k = 0; k < axis_count; ++k) words[k] = from_[k] + s * (to_[k] - from_[k]);
  words[u_] = centre_u_ + radius * std::cos(angle);
  words[v_] = centre_v_ + radius * std::sin(angle);
  return words;
}

}  // namespace trueaxis::nc
