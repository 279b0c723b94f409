// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "bench/cone_peer.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::peer {

/// Table 1 of Constantin et al.: x0, y0 (mm), l, m (1), k (mm), half angle (rad).
inline constexpr std::array<double, 6> table1_part = {0.05,   0.1,   0.0002,
                                                      0.0009, 402.0, 15.5 * rad_per_deg};
/// The drawing's values, from which the peers start. (The engine finds a start of its own.)
inline constexpr std::array<double, 6> table1_nominal = {0.0, 0.0,   0.0,
                                                         0.0, 400.0, 15.0 * rad_per_deg};
inline constexpr double table1_noise_mm = 0.01;
inline constexpr double table1_length_mm = 50.0;
inline constexpr int table1_readings_per_revolution = 10;

/// Constantin et al.'s helix of 10 readings per revolution over Z in [−50, 0] mm, `count` readings
/// whatever the feed (0.2 mm/rev at 2500), with independent Gaussian noise on X_M.
inline ProbeStream make_cone_stream(std::size_t count, std::uint64_t seed,
                                    double noise_mm = table1_noise_mm) {
  ProbeStream stream;
  stream.reading_mm.resize(count);
  stream.c_rad.resize(count);
  stream.position_mm.resize(count);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_mm);
  for (std::size_t i = 0; i < count; ++i) {
    const double c_rad = two_pi * static_cast<double>(i) / table1_readings_per_revolution;
    const double z_mm = -table1_length_mm * static_cast<double>(i) / static_cast<double>(count);
    stream.c_rad[i] = c_rad;
    stream.position_mm[i] = z_mm;
    stream.reading_mm[i] =
        cone_reading(table1_part.data(), std::cos(c_rad), std::sin(c_rad), z_mm) + noise(random);
  }
  stream.source = "table 1";
  return stream;
}

/// The six parameters as lengths that the data determine well (k and the half angle alone
/// correlate at −0.9999): x0, y0, 50 l, 50 m, radius at mid length, 50 × half angle, all mm.
inline std::array<double, 6> well_conditioned_mm(const std::array<double, 6>& p) {
  const double n = std::sqrt(1.0 - p[2] * p[2] - p[3] * p[3]);
  const double radius_mid = (p[4] + 0.5 * table1_length_mm / n) * std::tan(p[5]);
  return {p[0],
          p[1],
          table1_length_mm * p[2],
          table1_length_mm * p[3],
          radius_mid,
          table1_length_mm * p[5]};
}

}  // namespace trueaxis::peer
