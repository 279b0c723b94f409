// SPDX-License-Identifier: Apache-2.0
#include "associate/stream/stream_points.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "measure/centre_of_ball.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

namespace {

/// Whether the points are on the side of the tube that faces the axis.
bool towards_the_axis(const Feature& torus, const StreamPoints& points) {
  const Eigen::Vector3d middle(torus.point_mm.data()), along(torus.direction.data());
  double sum = 0.0;
  for (const Point3& point : points.points_mm)
    sum += (Eigen::Vector3d(point.data()) - middle).cross(along).norm();
  return sum < torus.radius_mm * static_cast<double>(points.points_mm.size());
}

}  // namespace

Element element_of(SurfaceKind surface) {
  expects(surface != SurfaceKind::own, "a surface of the catalogue");
  using enum Element;
  constexpr Element elements[] = {cone, cylinder, plane, circle, sphere, torus};
  return elements[static_cast<std::size_t>(surface)];
}

StreamPoints points_of_stream(const ProbeStream& stream, SurfaceKind surface,
                              const StreamPointOptions& options) {
  std::vector<Diagnostic> wrong;
  const auto refuse = [&](std::string why) { wrong.push_back({stream.source, 0, 0, why}); };
  const bool face = surface == SurfaceKind::plane, section = surface == SurfaceKind::section;
  if (face != (stream.kind == StreamKind::face))
    refuse(face ? "has X_M and no Z_M: a plane is associated with a face stream"
                : "is a face stream: associate a plane");
  if (!face && !section && !stream.has_position()) refuse("has no Z: associate a section");
  if (!stream.more_reading_mm.empty())
    refuse("has several sensors: points need the one at +X; give it a stream of its own");
  if (list_set_ups(stream).size() > 1)
    refuse("has several set-ups with different positions of the part: write a stream for each");
  const bool relative = !face && stream.indication == Indication::relative;
  if (relative && !stream.nominal_radius_mm)
    refuse("is a gauge's reading, not a position: give --nominal-radius-mm");
  StreamPoints out;
  out.ball_radius_mm =
      options.ball_radius_mm > 0.0 ? options.ball_radius_mm : stream.ball_radius_mm.value_or(0.0);
  if (relative && surface == SurfaceKind::cone && out.ball_radius_mm == 0.0)
    refuse(
        "is a gauge's reading of a cone, which a ball does not touch at its own Z: give "
        "--ball-radius-mm (small for a knife edge)");
  if (!wrong.empty()) throw InputError(std::move(wrong));
  if (out.ball_radius_mm == 0.0 && surface == SurfaceKind::cone)
    out.notes.emplace_back(
        "TrueAxis assumes that X_M is the contact. If it is a ball's centre, give "
        "--ball-radius-mm: "
        "the cone is then smaller by the radius over the cosine of its half angle");
  const double at_zero_mm =
      face ? 0.0 : centre_at_zero_mm(stream, out.ball_radius_mm, options.bore);
  out.points_mm.reserve(stream.size());
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const double c = std::cos(stream.c_rad[i]), s = std::sin(stream.c_rad[i]);
    if (face) {
      const double x = stream.position_mm[i];
      out.points_mm.push_back({x * c, x * s, stream.reading_mm[i]});
    } else {
      const double x = at_zero_mm + stream.reading_mm[i];
      out.points_mm.push_back({x * c, x * s, section ? 0.0 : stream.position_mm[i]});
    }
  }
  return out;
}

Feature surface_below(const AssociatedFeature& of_centres, const StreamPoints& points, bool bore) {
  Feature feature = of_centres.feature;
  const double ball = points.ball_radius_mm * (bore ? -1.0 : 1.0);
  switch (of_centres.element) {
    case Element::cone:
      feature.radius_mm -= ball / std::cos(feature.half_angle_rad);
      break;
    case Element::plane: {  // the ball is above the face, on the side of +Z
      const double up = feature.direction[2] < 0.0 ? -1.0 : 1.0;
      for (std::size_t i = 0; i < 3; ++i)
        feature.point_mm[i] -= up * points.ball_radius_mm * feature.direction[i];
      break;
    }
    case Element::torus:  // towards the axis is the groove of a shaft and the bead of a bore
      feature.minor_radius_mm += towards_the_axis(of_centres.feature, points) ? ball : -ball;
      break;
    default:
      feature.radius_mm -= ball;
  }
  return feature;
}

std::vector<SurfaceNumber> surface_numbers(SurfaceKind surface, const Feature& feature) {
  const Point3 &p = feature.point_mm, &d = feature.direction;
  const double up = d[2] < 0.0 ? -1.0 : 1.0;  // along +Z
  const double l = up * d[0], m = up * d[1], n = up * d[2];
  if (surface == SurfaceKind::plane)
    return {{"l", l, "1"}, {"m", m, "1"}, {"d", l * p[0] + m * p[1] + n * p[2]}};
  if (surface == SurfaceKind::section)
    return {{"x0", p[0]}, {"y0", p[1]}, {"radius", feature.radius_mm}};
  if (surface == SurfaceKind::sphere)
    return {{"x0", p[0]}, {"y0", p[1]}, {"z0", p[2]}, {"radius", feature.radius_mm}};
  const double s = p[2] / n;  // from where the axis crosses Z = 0 to the point
  std::vector<SurfaceNumber> numbers{
      {"x0", p[0] - s * l}, {"y0", p[1] - s * m}, {"l", l, "1"}, {"m", m, "1"}};
  if (surface == SurfaceKind::cone) {
    const double apex = feature.radius_mm / std::tan(feature.half_angle_rad);
    numbers.push_back({"k", s - up * apex});
    numbers.push_back({"half_angle", feature.half_angle_rad / rad_per_deg, "deg"});
  } else {
    if (surface == SurfaceKind::torus) numbers.push_back({"z0", s});
    numbers.push_back({"radius", feature.radius_mm});
    if (surface == SurfaceKind::torus) numbers.push_back({"minor_radius", feature.minor_radius_mm});
  }
  return numbers;
}

}  // namespace trueaxis
