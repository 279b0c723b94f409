// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "trueaxis/machine.hpp"

namespace trueaxis {

/// How far from straight the component errors of each axis are.
struct ErrorBends {
  /// Over which they bend once, mm or rad: the distance of two points of a table, a quarter of a
  /// wave, the scale of a polynomial over its terms. Infinite: they do not.
  AxisPositions length;
  /// Points of tables, ascending; where a table repeats itself there is one everywhere.
  std::array<std::vector<double>, axis_count> corners;
  std::array<bool, axis_count> corner_everywhere{};
  /// The largest change of slope there, of the tip a metre from where it turns: mm per mm or rad.
  AxisPositions corner_mm;

  /// What the corners between two positions of an axis do to the tip compared with a straight way.
  double off_mm(std::size_t axis, double from, double to) const;
};

ErrorBends bends_of(const ErrorModel& errors);

}  // namespace trueaxis
