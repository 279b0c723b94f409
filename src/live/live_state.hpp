// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "live/live_stream.hpp"
#include "measure/centre_step.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {

/// What a stream shows while it arrives.
struct LiveState {
  std::size_t readings = 0, used = 0, stride = 1;
  double turns = 0.0;
  FitResult fit;      ///< of a sample of the readings that are kept
  double U_mm = 0.0;  ///< of the axis at the worse end; infinite while it is not known
  std::optional<CentreStep> moved;  ///< the part slipped
  bool deaf = false;                ///< the probe does not read what the part does below it
  static constexpr std::size_t bins = 60;
  std::array<double, bins> left_mm{};  ///< mean residual over C; not a number: no reading
};

/// What the fit reads; none for a surface that is not met along a line through the spindle axis.
IdealReading ideal_reading(const FitResult& fit);

/// @param before the last fit with a known axis, if there is one: a deaf probe spoils the next
/// @throws InputError where the stream cannot be one of this surface
LiveState live_state(const LiveStream& stream, const FitOptions& options, const FitResult& before,
                     std::size_t look = 1);

/// Whether the readings of the last half revolution do not follow the axis: it would move them by
/// ten times their noise or more, and they move by less than a quarter of that.
/// @param noise_mm robust σ of a reading: the standard deviation holds the deaf readings too
bool probe_is_deaf(const ProbeStream& stream, const FitResult& fit, double noise_mm);

}  // namespace trueaxis
