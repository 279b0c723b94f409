// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "associate/files/association_files.hpp"
#include "associate/stream/stream_points.hpp"

namespace trueaxis {

/// A stream's readings associated by another criterion than along the probe line.
struct StreamAssociation {
  SurfaceKind surface = SurfaceKind::cylinder;
  AssociatedFeature of_centres{};  ///< through the points that were read: what is certified
  AssociatedFeature of_surface{};  ///< the surface that the ball touched
  StreamPoints stream{};
  PointText points{};  ///< the same points with their rows, for certificate and distances
};

/// @throws InputError as points_of_stream(); too few or degenerate points too
StreamAssociation associate_stream(const ProbeStream& stream, SurfaceKind surface,
                                   Criterion criterion, const StreamPointOptions& options);

/// Schema trueaxis.association/1 with `surface`, the numbers as `fit` names them, and
/// `ball_radius`.
std::string stream_association_json(const StreamAssociation& associated);
/// For a person at a terminal, 15 lines at most.
std::string stream_association_text(const StreamAssociation& associated);

}  // namespace trueaxis
