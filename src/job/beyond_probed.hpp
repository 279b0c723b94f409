// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "job/check.hpp"

namespace trueaxis {

/// Far from the probed length u of an axis grows as √12 distances over lengths: 2.9 and 8.7 of
/// them.
inline constexpr Threshold reserved_u_factor{"u", 10.0, "of the least within", "2.9 lengths away"};
inline constexpr Threshold refused_u_factor{"u", 30.0, "of the least within", "8.7 lengths away"};

/// u of the line that a reference gives at the worse end of the target over its least u within the
/// probed length (Eq. 119a). If the reference is in the datum, it is the datum's line. 1 for a
/// plane, where there is no u, and where nothing is fixed against it.
double u_beyond_probed(const PlannedJob& job, std::size_t reference);

/// That the cut lies so far from what was probed that u grows by more than `factor`.
std::optional<Reason> extrapolation(const PlannedJob& job, double factor, ReasonCode code);

/// Where the target lies between references that are judged each for itself: the line of [target]
/// that makes one datum of them.
std::optional<Reason> common_datum(const PlannedJob& job);

}  // namespace trueaxis
