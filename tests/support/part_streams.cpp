// SPDX-License-Identifier: Apache-2.0
#include "support/part_streams.hpp"

namespace trueaxis::testing {

std::vector<PartReading> probe(const Part& part) {
  constexpr double degree = std::numbers::pi / 180.0;
  std::mt19937_64 random(part.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<PartReading> readings;
  for (int s = 0; s < part.sections; ++s) {
    const double z = part.sections > 1 ? part.length_mm * s / (part.sections - 1) : 0.0;
    const double radius = part.radius_mm + z * std::tan(part.half_angle_deg * degree);
    for (int a = 0; a < part.angles; ++a) {
      const double c_deg = 360.0 * a / part.angles, c = c_deg * degree;
      const double across = part.y0_mm * std::cos(c) - part.x0_mm * std::sin(c);
      const double x = part.x0_mm * std::cos(c) + part.y0_mm * std::sin(c) +
                       std::sqrt(radius * radius - across * across);
      readings.push_back({x + part.noise_mm * noise(random), c_deg, z});
    }
  }
  return readings;
}

std::string csv(const std::vector<PartReading>& readings, const std::string& header) {
  std::string text = header;
  for (const PartReading& r : readings) {
    char line[96];
    std::snprintf(line, sizeof line, "%.17g,%.17g,%.17g\n", r.x_mm, r.c_deg, r.z_mm);
    text += line;
  }
  return text;
}

}  // namespace trueaxis::testing
