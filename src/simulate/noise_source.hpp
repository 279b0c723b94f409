// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <boost/random/student_t_distribution.hpp>
#include <cstdint>
#include <random>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// Uniform on [0, 1) with 53 bits, the same on every standard library.
inline double uniform_01(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11U) * 0x1p-53;
}

/// An engine for one purpose of a scenario; purposes do not disturb each other.
std::mt19937_64 engine_for(std::uint64_t seed, std::uint32_t purpose);

/// @throws InputError where a number is outside its range.
void validate(const Noise& noise);

/// Whether an impulse into ε_i = Σ φ_j ε_{i−j} + e_i dies out.
bool is_stationary(const std::vector<double>& phi);

/// What noise adds to one reading.
struct NoiseDraw {
  double error_mm = 0.0;
  bool outlier = false;
};

class NoiseSource {
 public:
  NoiseSource(const Noise& noise, std::uint64_t seed);

  /// `tan_incidence`: of the angle between normal and probe line. `away`: the reading's sign of
  /// "away from the material", for one-sided outliers.
  NoiseDraw draw(double tan_incidence, double away);
  bool wants_incidence() const { return noise_.incidence > 0.0; }

 private:
  double unit_variate();
  double correlated_variate();

  Noise noise_;
  std::mt19937_64 gaussian_, uniform_, outliers_;
  boost::random::normal_distribution<double> normal_;
  boost::random::student_t_distribution<double> student_;
  double student_scale_ = 1.0, innovation_ = 1.0, state_ = 0.0;
  bool started_ = false;
  std::vector<double> recent_;  ///< of an autoregression, the newest first
};

}  // namespace trueaxis::virtual_lathe
