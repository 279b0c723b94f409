// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

#include "correct/spectrum.hpp"

namespace trueaxis {

/// How a table is run.
struct Motion {
  double omega_rad_per_s = 0.0;    ///< of the spindle, > 0
  double position_mm_per_s = 0.0;  ///< of the feed, signed
  int rows_per_revolution = 360;
};

Motion motion_of(const Profile& profile, double speed_rpm);

/// The response at a frequency of either sign: that of a real system.
std::complex<double> signed_response(const Actuator& actuator, double frequency_hz);

/// Share of a harmonic that linear interpolation between rows keeps: sinc²(n/M) (Eq. 114).
double kept_by_interpolation(int order, int rows_per_revolution);

/// What becomes of one harmonic on its way from the table to the tool: the table is interpolated
/// linearly between rows (which leaves sinc²(n/M) of it), sampled, held and followed by the
/// actuator (H).
struct HarmonicPath {
  int order = 0;
  std::complex<double> response;        ///< sinc² · H at nω
  std::complex<double> response_slope;  ///< its derivative by ω, s
  double unknown = 0.0;                 ///< share of the response that its points do not show
};

std::vector<HarmonicPath> harmonic_paths(const Actuator& actuator, const Motion& motion,
                                         const std::vector<int>& orders);

/// The command's amplitude b for a wanted amplitude a that changes slowly, so that the tool follows
/// a to first order in ȧ: with G = 1/response, b = G a − i G' ȧ (order 0: a ramp is led by the
/// delay).
std::complex<double> commanded(const HarmonicPath& path, const SlowAmplitude& wanted,
                               double position_mm_per_s);

/// Adds Σ Re{(b_n − a_n) e^{inψ}} to the wanted values of the rows (Eq. 115).
void precompensate(const Spectrum& spectrum, const Actuator& actuator, const Motion& motion,
                   CorrectionRows& rows);

}  // namespace trueaxis
