// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

/// Streams of an untilted, off-centre cone or cylinder: every section is a circle, so that X_M has
/// an elementary closed form that shares nothing with the engine's intersection.
namespace trueaxis::testing {

struct PartReading {
  double x_mm, c_deg, z_mm;
};

struct Part {
  double x0_mm = 0.08, y0_mm = -0.06;
  double radius_mm = 30.0;      ///< at Z = 0
  double half_angle_deg = 0.0;  ///< positive where the radius grows with Z
  double length_mm = 40.0;      ///< probed from Z = 0 to here
  int sections = 9, angles = 16;
  double noise_mm = 0.0;
  unsigned seed = 4711;
};

std::vector<PartReading> probe(const Part& part);

std::string csv(const std::vector<PartReading>& readings,
                const std::string& header = "X_M[mm],C[deg],Z[mm]\n");

}  // namespace trueaxis::testing
