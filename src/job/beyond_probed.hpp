// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "trueaxis/job.hpp"

namespace trueaxis {

/// Far from the probed length u of an axis grows as √12 distances over lengths: 2.9 and 8.7 of
/// them.
inline constexpr double reserved_u_factor = 10.0, refused_u_factor = 30.0;

/// u of the line that a reference gives at the worse end of the target over its least u within the
/// probed length (Eq. 119a); of one that is in the datum, the datum's line. 1 for a plane, where
/// there is no u, and where nothing is held against it.
double u_beyond_probed(const JobResult& result, std::size_t reference);

/// That the cut lies so far from what was probed that u grows by more than `factor`, a sentence
/// without its end; empty: it does not.
std::string extrapolation(const JobResult& result, double factor);

/// Where the target lies between references that are judged each for itself: the line of [target]
/// that makes one datum of them. Empty: it does not.
std::string common_datum(const JobResult& result);

}  // namespace trueaxis
