// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// A line through (x0, y0, 0) in the spindle's frame, with direction cosines l, m.
struct StraightAxis {
  double x0_mm = 0.0, y0_mm = 0.0, l = 0.0, m = 0.0;
};

/// Where the axis of a part runs at `end_s`, after slips and creeps: of a bow the line nearest to
/// it (least squares) over the part from low to high, mm along Z; nothing: no effect moves or bends
/// it.
std::optional<StraightAxis> axis_at_end(const Scenario& scenario, const Chucking& setup,
                                        double low_mm, double high_mm, double end_s);

}  // namespace trueaxis::virtual_lathe
