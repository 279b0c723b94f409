// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

#include "correct/profile.hpp"

namespace trueaxis {

/// Complex amplitudes of the harmonics of one revolution at fixed position, by order:
/// profile(ψ) = Σ Re{a_n e^{inψ}}, ψ the angle turned since the first row in the sense of cutting.
/// The machine angle is C = c_start + sense · ψ (Eq. 113).
std::vector<std::complex<double>> harmonics_at(const Profile& profile, double position_mm,
                                               int max_order);

/// The harmonics that a table holds, cos convention in C, at both ends of the cut: orders 0 to 8
/// above 1 nm. Order 0 is the signed mean (phase 0).
std::vector<CorrectionHarmonic> table_harmonics(const Profile& profile, const Actuator& actuator);

/// One harmonic a_n as it varies along the cut.
struct SlowAmplitude {
  std::complex<double> value;  ///< mm
  std::complex<double> slope;  ///< per mm of position, 1
};

/// The harmonics of a profile as polynomials in the position (Chebyshev interpolation at 9 nodes:
/// exact for the linear eccentricity of a tilted axis, and far below 1 nm for what grows with its
/// square).
class Spectrum {
 public:
  explicit Spectrum(const Profile& profile);

  double start_mm() const { return start_mm_; }
  double end_mm() const { return end_mm_; }
  /// Orders that matter (above 1e-9 mm somewhere), ascending.
  const std::vector<int>& orders() const { return orders_; }
  /// The amplitudes at a position, in the order of `orders()`.
  void at(double position_mm, std::vector<SlowAmplitude>& amplitudes) const;

 private:
  double start_mm_ = 0.0, end_mm_ = 0.0;
  std::vector<int> orders_;
  std::vector<std::vector<std::complex<double>>> coefficients_;  ///< Chebyshev series of each order
};

}  // namespace trueaxis
