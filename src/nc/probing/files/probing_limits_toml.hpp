// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "nc/probing/probing.hpp"

namespace trueaxis {

/// Reads what a probing program must keep to. Every key is required but ball_radius_mm (0),
/// rate_hz and spin_up_s (of an analogue probe only), those of a bore (bore_…, stylus_…) and
/// [control]; keys carry their unit:
///
///     [limits]  x_mm = [-60, 120]  z_mm = [-150, 60]  speed_rpm
///     [part]    reach_mm  front_mm  bore_radius_mm  bore_bottom_mm
///               bore_mouth_radius_mm
///     [probe]   kind = "touch" | "analogue"  ball_radius_mm  feed_mm_per_min  clearance_mm
///               search_mm  rate_hz  spin_up_s  stylus_radius_mm  stylus_length_mm
///     [control] work_offset = "G54"  x = "radius" | "diameter"  gcode_system = "A" | "B" | "C"
///
/// @throws InputError with every diagnostic
nc::ProbingLimits parse_probing_limits(std::string_view content, const std::string& path);

}  // namespace trueaxis
