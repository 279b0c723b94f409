// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// What to do if the ball is larger than the path of its centre.
inline constexpr const char* mend_ball_radius =
    "give the radius of the probe's ball, or remove it if the readings are contact points";

/// Whether the one set-up of a lateral stream is probed on the rear side: the sign of X_M tells,
/// for a gauge what is stated.
bool is_probed_behind(const ProbeStream& stream);

/// X of the ball's centre in the machine frame at a reading of 0, for one set-up: 0 for positions.
/// A gauge is then at its nominal radius, a ball further out or further in (`bore`); without a
/// nominal radius 0.
double centre_at_zero_mm(const ProbeStream& stream, double ball_mm, bool bore);

}  // namespace trueaxis
