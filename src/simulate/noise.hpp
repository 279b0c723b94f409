// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/student_t_distribution.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {

/// Whether an impulse into ε_i = Σ φ_j ε_{i−j} + e_i dies out.
bool is_stationary(const std::vector<double>& phi);

/// The series ε_i = Σ φ_j ε_{i−j} + q e_i of standard deviation 1 from variates e of standard
/// deviation 1. That of the first order (`rho`) begins with a variate, one of `autoregression` runs
/// in until an impulse has died out.
class Autoregression {
 public:
  /// @throws InputError for an autoregression that is not stationary.
  explicit Autoregression(const Noise& noise);

  template <class Variate>
  double next(Variate&& variate) {
    for (; run_in_ > 0; --run_in_) step(variate());
    if (begun_) return step(variate());
    begun_ = true;
    return recent_.front() = variate();
  }

 private:
  double step(double variate) {
    double next = innovation_ * variate;
    for (std::size_t j = 0; j < recent_.size(); ++j) next += phi_[j] * recent_[j];
    std::shift_right(recent_.begin(), recent_.end(), 1);
    return recent_.front() = next;
  }

  std::vector<double> phi_, recent_;  ///< recent values, the newest first
  double innovation_ = 1.0;           ///< q
  std::size_t run_in_ = 0;
  bool begun_ = false;
};

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
