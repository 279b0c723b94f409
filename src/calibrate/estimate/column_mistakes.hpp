// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "trueaxis/calibration.hpp"

namespace trueaxis::calibrate_detail {

/// A way in which columns are written wrongly, and how they are mended.
struct Mistake {
  std::string what, mend;
  std::function<void(MachineMeasurement&)> undo;
  /// The factor by which mending makes the readings smaller, and the residuals with it.
  double smaller = 1.0;
};

/// Of every column that these files have.
std::vector<Mistake> column_mistakes(const Machine& machine,
                                     std::span<const MachineMeasurement> data);

/// Lengths of tools in the rows of these files that may be wrong against the others: none of one
/// length, as location errors read alike, and of two one.
std::vector<double> tool_lengths(const Machine& machine, std::span<const MachineMeasurement> data);

/// The tools of length `stated_mm` are longer by `more_mm`, against all others.
Mistake longer_tool(double stated_mm, double more_mm);

}  // namespace trueaxis::calibrate_detail
