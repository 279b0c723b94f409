// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::blind {

enum class PlanId { p1, p2, p3, p4, p5, p6, p7, p8 };
enum class SurfaceId { cone, cylinder };

std::string to_string(PlanId plan);
std::string to_string(SurfaceId surface);
PlanId plan_from(std::string_view text);        ///< @throws std::invalid_argument
SurfaceId surface_from(std::string_view text);  ///< @throws std::invalid_argument
std::vector<PlanId> all_plans();

/// Length that every plan probes, and the mean radius at its start.
inline constexpr double start_mm = 0.0, end_mm = 60.0, radius_mm = 40.0;
inline constexpr double tangent = 0.1;  ///< of the cone's half angle
inline constexpr double eccentricity_mm = 0.2, tilt_rad = 1e-3;
/// Incommensurate: orders up to 11 are below half of it, and none is the alias of another.
inline constexpr double readings_per_revolution = 23.7;

/// A part with 0.2 mm of eccentricity and 1 mrad of tilt that is probed by a plan of theory.md
/// with about 1500 readings; no noise, no effect, seed 1. `variant` (0 … 3) turns eccentricity and
/// tilt.
virtual_lathe::Scenario plain_scenario(PlanId plan, SurfaceId surface, int variant);

/// The scenario with a further measurement, by the code of its separator
/// (docs/reference/effects.md: RV RZ 2W DW ST RC RE OZ RM XJ), appended: the passes at hand stay as
/// they are. Nothing: MS, which is another part, and unknown codes.
std::optional<virtual_lathe::Scenario> with_measurement(virtual_lathe::Scenario scenario,
                                                        std::string_view code);

/// Instant of the last reading, s.
double duration_s(const virtual_lathe::Plan& plan);

}  // namespace trueaxis::blind
