// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "form/trace.hpp"

namespace trueaxis::form {

/// A profile filter of ISO 16610 over the places of one trace: the long waves of values there.
/// Linear once made; of a robust filter the weights that it found stay.
class LowPass {
 public:
  LowPass() = default;
  LowPass(const LowPass&) = delete;
  LowPass& operator=(const LowPass&) = delete;
  virtual ~LowPass() = default;
  /// @param value_mm a value for every place of the trace
  virtual std::vector<double> operator()(std::span<const double> value_mm) const = 0;
};

/// Waves as long as half of this are the shortest that a step may be bridged by: Eq. 262.
double longest_step(double cutoff);

/// Gaussian filter as a local regression of first degree with the true places (Eqs. 260-262):
/// where readings are even it is that of ISO 16610-21; at ends, gaps and uneven places its first
/// moment is kept (ISO 16610-28). Transmission at the cut-off 50 %.
/// @param cutoff wavelength in the unit of the trace's places
std::unique_ptr<LowPass> gaussian_low_pass(const Trace& trace, double cutoff);

/// Robust Gaussian regression filter of second degree (ISO 16610-31, Eq. 263): readings further off
/// than 4.4478 medians of the residuals do not count, nearer ones count by Tukey's biweight.
std::unique_ptr<LowPass> robust_low_pass(const Trace& trace, double cutoff);

/// Linear spline filter (ISO 16610-22, Eq. 264), by the true places; natural at ends and gaps.
std::unique_ptr<LowPass> spline_low_pass(const Trace& trace, double cutoff);

/// What the Gaussian filter lets through of a wave, cut-off and wave in one unit. Eq. 260.
double gaussian_transmission(double cutoff, double wavelength);
/// The same of the linear spline filter at readings `step` apart. Eq. 264.
double spline_transmission(double cutoff, double wavelength, double step);
/// The same of the regression of second degree before any weight is lowered. Eq. 263.
double robust_transmission(double cutoff, double wavelength);

}  // namespace trueaxis::form
