// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Z (of a face |X|) from and to where the target lies on the probed length of a reference, mm.
/// Nothing where they do not meet, or where the readings show no place of the surface (a relative
/// gauge, a face next to a shaft).
std::optional<std::pair<double, double>> overlap_mm(const PlannedJob& result,
                                                    std::size_t reference);

/// What lies between target and probed surface at one place.
struct Place {
  double position_mm = 0.0, c_rad = 0.0;
  double material_mm = 0.0;  ///< along X, of a face along Z; negative: the target is outside of it
  double U_mm = 0.0;
};

struct MaterialMet {
  Place least, most;
};

/// The material that the tool would meet over the overlap: from the fitted surface as clamped to
/// the target about the target axis. With features of two sides it is the wall between them.
std::optional<MaterialMet> material_over(const PlannedJob& result, std::size_t reference);

}  // namespace trueaxis
