// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// Angles from which on an axis is given: six take five lobes, the commonest of ground parts, for
/// an eccentricity.
inline constexpr int least_angles = 7;

/// The lowest m from 3 to 100 for which the readings are at m even angles, or drift from them by so
/// little that |mean of exp(i m C)| > ½: lobes of the orders m ± 1 then move the axis by half their
/// amplitude and more, whatever a fit says (Eq. 315). None: no such lobes look like eccentricity.
std::optional<int> angles_alike(const ProbeStream& stream);

}  // namespace trueaxis
