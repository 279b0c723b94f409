// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>

#include "simulate/clean_stream.hpp"
#include "simulate/recorder.hpp"
#include "simulate/variates.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

/// Adds σ times an AR(1) sequence of standard deviation 1, wider where the incidence is oblique.
void add_correlated(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                    std::span<double> reading_mm) {
  Xoshiro bits(seed, 1);
  const double innovation = std::sqrt(1.0 - noise.rho * noise.rho);
  double state = 0.0;
  for (std::size_t i = 0; i < reading_mm.size(); ++i) {
    const double fresh =
        noise.student_dof > 2.0 ? student_variate(bits, noise.student_dof) : normal_variate(bits);
    state = i == 0 ? fresh : noise.rho * state + innovation * fresh;
    const double tangent = noise.incidence > 0.0 ? clean.tan_incidence[i] : 0.0;
    const double widened = std::sqrt(1.0 + noise.incidence * tangent * tangent);
    reading_mm[i] += noise.sigma_mm * widened * state;
  }
}

/// An autoregression of any order, as simulate() draws it.
void add_autoregression(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                        std::span<double> reading_mm) {
  Noise part;
  part.sigma_mm = noise.sigma_mm, part.student_dof = noise.student_dof;
  part.autoregression = noise.autoregression, part.incidence = noise.incidence;
  NoiseSource source(part, seed);
  for (std::size_t i = 0; i < reading_mm.size(); ++i) {
    const double tangent = noise.incidence > 0.0 ? clean.tan_incidence[i] : 0.0;
    reading_mm[i] += source.draw(tangent, 1.0).error_mm;
  }
}

void add_outliers(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                  std::span<double> reading_mm) {
  Xoshiro bits(seed, 3);
  for (std::size_t i = 0; i < reading_mm.size(); ++i) {
    const double chance = bits.uniform();
    const double size = noise.outlier_size_mm * (0.5 + bits.uniform());
    const double side = bits.uniform() < 0.5 ? -1.0 : 1.0;
    if (chance >= noise.outlier_fraction) continue;
    reading_mm[i] += size * (noise.outliers_one_sided ? clean.away[i] : side);
  }
}

}  // namespace

void draw_readings(const CleanStream& clean, const Noise& noise, std::uint64_t seed,
                   std::span<double> reading_mm) {
  expects(reading_mm.size() == clean.value_mm.size(), "a place for every reading");
  expects(noise.incidence == 0.0 || !clean.tan_incidence.empty(), "incidence of every reading");
  std::copy(clean.value_mm.begin(), clean.value_mm.end(), reading_mm.begin());
  const bool white = noise.rho == 0.0 && noise.student_dof == 0.0 && noise.incidence == 0.0;
  if (noise.sigma_mm > 0.0) {
    if (!noise.autoregression.empty()) {
      add_autoregression(clean, noise, seed, reading_mm);
    } else if (white) {
      Xoshiro bits(seed, 1);
      add_normal_variates(bits, noise.sigma_mm, reading_mm);
    } else {
      add_correlated(clean, noise, seed, reading_mm);
    }
  }
  if (noise.uniform_mm > 0.0) {
    Xoshiro bits(seed, 2);
    for (double& reading : reading_mm) reading += noise.uniform_mm * (2.0 * bits.uniform() - 1.0);
  }
  if (noise.outlier_fraction > 0.0) add_outliers(clean, noise, seed, reading_mm);
  if (clean.sensor == SensorLimits{}) return;
  for (double& reading : reading_mm) reading = shown(clean.sensor, reading).value_mm;
}

}  // namespace trueaxis::virtual_lathe
