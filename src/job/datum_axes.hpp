// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// The axis that another association gives the same readings (ISO 5459).
struct DatumAxis {
  Criterion criterion = Criterion::gaussian;
  bool of_iso_5459 = false;  ///< its default of 2011 for this feature
  Axis axis;
  std::array<double, 2> off_mm{};  ///< from the axis of the job, at the lower and the upper end
  double radius_mm = 0.0;          ///< of a cylinder, that of the ball's centre included
  std::string why{};               ///< why there is none; else empty
};

/// What the others of the associations would give a reference, over its probed length: orthogonal,
/// from its readings without what is not of the part (Eq. 293). Extreme associations rest on a few
/// readings and take their noise in whole: they are stated without U. Empty: a section, a face, a
/// gauge without a radius, several set-ups, and where the job has no axis
/// or asks for no values of form.
std::vector<DatumAxis> datum_axes(const JobResult& result, std::size_t reference);

}  // namespace trueaxis
