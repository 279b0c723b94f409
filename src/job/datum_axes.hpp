// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// What the others of the associations would give a reference, over its probed length: orthogonal,
/// from its readings without what is not of the part (Eq. 293). Extreme associations rest on a few
/// readings and have all of their noise: they are stated without U. Empty: a section, a face, a
/// gauge without a radius, several set-ups, and where the job has no axis or asks for no values of
/// form.
std::vector<DatumAxis> datum_axes(const PlannedJob& result, std::size_t reference);

/// Where the ball's centre was at the readings that count, without what is not of the part, in
/// the part frame (Eqs. 1, 293): the axis of the centres is the part's.
std::vector<Point3> datum_points(const PlannedJob& result, std::size_t reference);

/// The axis of one association; `why` says where there is none.
DatumAxis datum_axis(std::span<const Point3> points_mm, Element element, Criterion criterion,
                     bool bore);

/// @throws Refusal if the association of a reference cannot take its stream
void expect_associable(const JobReference& reference, const ProbeStream& stream);

/// By how much the axis of a reference's `association` is off that of least squares, from the same
/// readings, at z_ref of the fit used. It has the covariance that their noise gives this difference
/// (Eq. 303). Nothing where the job states none, or least squares. @throws Refusal where the
/// readings give no such axis
std::optional<AxisEstimate> associated_difference(const PlannedJob& result, std::size_t reference);

}  // namespace trueaxis
