// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/random/normal_distribution.hpp>
#include <boost/random/student_t_distribution.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "simulate/autoregression.hpp"
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

/// By how much an oblique incidence widens the noise; `tangent` of the angle of normal and probe.
inline double widening(const Noise& noise, double tangent) {
  return std::sqrt(1.0 + noise.incidence * tangent * tangent);
}

/// An outlier's error in mm, or none; three uniform variates either way. `away`: the reading's sign
/// of "away from the material", for one-sided outliers.
template <class Uniform>
std::optional<double> draw_outlier(const Noise& noise, double away, Uniform&& uniform) {
  const double chance = uniform();
  const double size_mm = noise.outlier_size_mm * (0.5 + uniform());
  const double side = uniform() < 0.5 ? -1.0 : 1.0;
  if (chance >= noise.outlier_fraction) return std::nullopt;
  return size_mm * (noise.outliers_one_sided ? away : side);
}

/// Variates of standard deviation 1, normal or Student's t: Boost's distributions on an engine of
/// the scenario.
class UnitVariates {
 public:
  UnitVariates(const Noise& noise, std::uint64_t seed);
  double operator()() { return heavy_ ? scale_ * student_(engine_) : normal_(engine_); }

 private:
  bool heavy_;
  double scale_ = 1.0;
  std::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
  boost::random::student_t_distribution<double> student_;
};

/// What noise adds to one reading.
struct NoiseDraw {
  double error_mm = 0.0;
  bool outlier = false;
};

class NoiseSource {
 public:
  NoiseSource(const Noise& noise, std::uint64_t seed);

  /// `tan_incidence`: of the angle between normal and probe line. `away` as of draw_outlier().
  NoiseDraw draw(double tan_incidence, double away);
  bool wants_incidence() const { return noise_.incidence > 0.0; }

 private:
  Noise noise_;
  UnitVariates variates_;
  Autoregression series_;
  std::mt19937_64 uniform_, outliers_;
};

}  // namespace trueaxis::virtual_lathe
