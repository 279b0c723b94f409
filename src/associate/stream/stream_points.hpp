// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trueaxis/association.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// How the readings of a stream become points.
struct StreamPointOptions {
  bool bore = false;            ///< probed from inside
  double ball_radius_mm = 0.0;  ///< readings are of a ball's centre; 0: as the stream says, else 0
};

/// Readings as points of the part frame (Eq. 1): (X_M cos C, X_M sin C, Z), of a face
/// (X cos C, X sin C, Z_M), mm. They are those of the ball's centre; the surface lies
/// `ball_radius_mm` from an element through them (Eq. 300).
struct StreamPoints {
  std::vector<Point3> points_mm;
  double ball_radius_mm = 0.0;  ///< 0: X_M is the contact
  std::vector<std::string> notes{};
};

/// The element of a surface; nothing of one that has none (a profile of one's own).
Element element_of(SurfaceKind surface);

/// @throws InputError with all that keeps the readings from being points: several sensors or
/// set-ups, a gauge without a nominal radius, a surface of the other kind of stream.
StreamPoints points_of_stream(const ProbeStream& stream, SurfaceKind surface,
                              const StreamPointOptions& options);

/// The element of the surface that a ball touches whose centres `of_centres` passes: the parallel
/// one, a ball's radius nearer to the material (Eq. 300).
Feature surface_below(const AssociatedFeature& of_centres, const StreamPoints& points, bool bore);

/// The numbers of a surface as `fit` names them: x0, y0 where the axis crosses Z = 0, its cosines
/// l, m, the cone's apex k along the axis (Eq. 3), radius, half_angle; of a plane those of
/// `fit --surface plane`.
struct SurfaceNumber {
  std::string name;
  double value = 0.0;
  const char* unit = "mm";
};
std::vector<SurfaceNumber> surface_numbers(SurfaceKind surface, const Feature& feature);

}  // namespace trueaxis
