// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <complex>
#include <vector>

namespace trueaxis {

/// One point of a measured frequency response.
struct ResponsePoint {
  double frequency_hz = 0.0;
  double gain = 1.0;
  double phase_rad = 0.0;
};

/// A fast tool servo. Defaults: the 600 µm, 600 Hz piezo of Constantin et al. (section 3.3).
struct Actuator {
  double stroke_mm = 0.6;  ///< full travel; the correction uses it about its middle
  double natural_frequency_hz = 600.0;
  double damping = 0.7;               ///< ζ: −3 dB then falls on the natural frequency
  double delay_s = 0.0;               ///< pure transport delay of drive and bus
  double slew_mm_per_s = 200.0;       ///< amplifier current: full stroke as a sine at about 100 Hz
  double sampling_hz = 20000.0;       ///< set-points a second, held between (zero-order hold)
  double stroke_reserve = 0.1;        ///< share of the stroke kept free for what was not modelled
  double following_limit_mm = 0.001;  ///< predicted following error that is still accepted
  bool precompensate = true;          ///< invert the response per harmonic
  std::vector<ResponsePoint>
      measured;  ///< replaces the second-order model when there (ascending frequency)

  /// Position over set-point at a frequency ≥ 0 (e^{+iωt} convention): second order or measured
  /// response, delay, and the hold of the sampling: H = ω_n²/(ω_n² − ω² + 2iζω_nω) e^{−iωτ} sinc
  /// e^{−iωT/2}.
  std::complex<double> response(double frequency_hz) const;

  /// Lowest frequency at which |response| falls to −3 dB, Hz.
  double bandwidth_hz() const;

  void validate() const;  ///< @throws ContractViolation naming quantity, value and limit
};

}  // namespace trueaxis
