// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "form/low_pass.hpp"
#include "form/trace.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis::form {

/// Readings that a wave at the cut-off needs at least (ISO 12181-2, 12180-2).
inline constexpr double least_points_per_cycle = 7.0;

/// Readings a cycle of the wave `cutoff`: by the step that three quarters of the trace keep below.
double points_per_cycle(const Trace& trace, double cutoff);

/// The highest order that the readings of a closed trace carry: 7 of them a wave, and no gap of
/// more than half a wave unless gaps do not count.
int highest_order(const Trace& trace, bool gaps_count = true);

/// Why the pass band cannot be had of a closed trace, and what can; empty: it can.
std::string sampling_trouble(const Trace& trace, const FormOptions& options);

/// The largest amplitude of a wave of so many undulations that a ball follows down to the ground,
/// on a shaft or in a bore of this radius; infinite where any. Eq. 269.
double followed_amplitude_mm(double upr, double radius_mm, double ball_mm, bool bore);

/// How much of a wave at the cut-off the filter lets through over these places: its root mean
/// square after over before.
double measured_transmission(const Trace& trace, const LowPass& filter, double cutoff);

/// The share of the amplitude of an order that the filter's upper cut-off lets through, and that
/// the pass band does. @param step_rad between readings, which the spline's depends on
double passed_by_low_pass(const FormOptions& options, double order, double step_rad);
double passed_by_band(const FormOptions& options, double order);

/// The profile's low-pass of a kind; nothing for none.
std::unique_ptr<LowPass> low_pass(ProfileFilter kind, const Trace& trace, double cutoff);

}  // namespace trueaxis::form
