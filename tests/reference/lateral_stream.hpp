// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "bench/peers_ceres.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::reference {

/// How a test stream is probed: a helix of 10.3 readings per revolution (incommensurate, so that
/// every spindle angle comes up) over Z in [0, length].
struct Helix {
  std::size_t readings = 2500;
  double length_mm = 50.0;
  double noise_mm = 0.01;
  double outlier_share = 0.0;  ///< of the readings, 0.1 to 0.5 mm too large: chips
  bool position = true;        ///< false: one section, no Z column
};

/// What a Ceres residual of peers_ceres.hpp predicts along the helix, with Gaussian noise.
template <typename Residual>
ProbeStream simulate(const std::vector<double>& part, const Helix& helix, std::uint64_t seed) {
  ProbeStream stream;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, helix.noise_mm);
  std::uniform_real_distribution<double> share(0.0, 1.0), chip_mm(0.1, 0.5);
  for (std::size_t i = 0; i < helix.readings; ++i) {
    const double c_rad = two_pi * static_cast<double>(i) / 10.3;
    const double z_mm = helix.position ? helix.length_mm * static_cast<double>(i) /
                                             static_cast<double>(helix.readings)
                                       : 0.0;
    double x_mm = 0.0;
    Residual{{std::cos(c_rad), std::sin(c_rad), z_mm, 0.0}}(part.data(), &x_mm);
    x_mm += noise(random);
    if (share(random) < helix.outlier_share) x_mm += chip_mm(random);
    stream.c_rad.push_back(c_rad);
    stream.reading_mm.push_back(x_mm);
    if (helix.position) stream.position_mm.push_back(z_mm);
  }
  return stream;
}

}  // namespace trueaxis::reference
