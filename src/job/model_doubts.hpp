// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "job/check.hpp"

namespace trueaxis {

/// The diagnosis moved an axis, within the cut, by more than its U against the ideal fit while a
/// cause of it has rivals or a pattern has no cause.
extern const JobCheck axes_open;

/// Readings that nobody diagnosed leave what correlates.
extern const JobCheck undiagnosed_correlated;

/// More is left than the noise that was stated.
extern const JobCheck noise_over_stated;

/// A bow that one manner of probing does not tell from a vibration.
extern const JobCheck bow_or_vibration;

/// A cause that is improbable by its size alone explains a finding as well as the named one and
/// would put the axis elsewhere by so much that the cut were far out of the tolerance: how
/// improbable it is nobody knows so well.
extern const JobCheck improbable_and_far;

/// What `axes_open` finds.
Reasons open_axes(const PlannedJob& job);

}  // namespace trueaxis
