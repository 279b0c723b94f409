// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "trueaxis/association.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {

/// The axis that another association gives the same readings (ISO 5459; theory.md, Eq. 293).
struct DatumAxis {
  Criterion criterion = Criterion::gaussian;
  bool of_iso_5459 = false;  ///< its default of 2011 for this feature
  Axis axis;
  std::array<double, 2> off_mm{};  ///< from the axis of the job, at the lower and the upper end
  double radius_mm = 0.0;          ///< of a cylinder, that of the ball's centre included
  std::string why{};               ///< why there is none; else empty
};

}  // namespace trueaxis
