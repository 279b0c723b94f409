// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// y'' + 2 ζ ω y' + ω² y = ω² u for a held u, solved exactly: with complex eigenvalues s1, s2 of
/// the homogeneous equation, y − u = a e^{s1 t} + b e^{s2 t}. Any damping but exactly critical,
/// which is moved by 1e-9.
class SecondOrderServo {
 public:
  explicit SecondOrderServo(const CutActuator& actuator) {
    const double w = 2.0 * std::numbers::pi * actuator.natural_frequency_hz;
    const double zeta = std::abs(actuator.damping - 1.0) < 1e-9 ? 1.0 + 1e-9 : actuator.damping;
    const std::complex<double> root = std::sqrt(std::complex<double>(zeta * zeta - 1.0));
    s1_ = w * (-zeta + root);
    s2_ = w * (-zeta - root);
  }

  void rest_at(double position_mm) {
    y_ = held_ = position_mm;
    v_ = 0.0;
  }
  /// Sets the held set-point from now on.
  void hold(double set_point_mm) { held_ = set_point_mm; }

  /// Position after `dt` of the present hold, without moving on.
  double position_after(double dt_s) const {
    const auto [a, b] = amplitudes();
    return held_ + (a * std::exp(s1_ * dt_s) + b * std::exp(s2_ * dt_s)).real();
  }
  void advance(double dt_s) {
    const auto [a, b] = amplitudes();
    const std::complex<double> e1 = a * std::exp(s1_ * dt_s), e2 = b * std::exp(s2_ * dt_s);
    y_ = held_ + (e1 + e2).real();
    v_ = (s1_ * e1 + s2_ * e2).real();
  }

 private:
  struct Amplitudes {
    std::complex<double> a, b;
  };
  Amplitudes amplitudes() const {
    const std::complex<double> off = y_ - held_;
    const std::complex<double> a = (v_ - s2_ * off) / (s1_ - s2_);
    return {a, off - a};
  }

  std::complex<double> s1_, s2_;
  double y_ = 0.0, v_ = 0.0, held_ = 0.0;
};

}  // namespace trueaxis::virtual_lathe
