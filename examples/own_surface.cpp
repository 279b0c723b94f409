// SPDX-License-Identifier: Apache-2.0
// A surface of one's own: a crowned roller, radius R − (h − m)²/2ρ over the height h along its
// axis.
#include <cmath>
#include <cstdio>
#include <memory>
#include <trueaxis/trueaxis.hpp>

using namespace trueaxis;

class Crowned final : public RevolvedProfile {
 public:
  std::vector<Parameter> parameters() const override {
    return {{.name = "radius", .unit = "mm", .start = 20.0},
            {.name = "crown", .unit = "1/mm", .start = 0.0, .length_mm = 200.0},
            {.name = "slope", .unit = "1", .start = 0.0, .length_mm = 20.0}};
  }
  Radius radius(double height_mm, std::span<const double> p) const override {
    const double u = height_mm - 20.0;  // from the middle of the roller
    return {.mm = p[0] - 0.5 * p[1] * u * u + p[2] * u,
            .per_height = -p[1] * u + p[2],
            .per_parameter = {1.0, -0.5 * u * u, u}};
  }
};

int main() {
  const double x_mm = 0.05, radius_mm = 20.0, crown = 1.0 / 2000.0;
  ProbeStream stream;  // 40 turns, the roller 50 µm off along X, its axis parallel to the spindle
  for (int i = 0; i < 960; ++i) {
    const double c_rad = 2.0 * M_PI * i / 24.0, z_mm = i / 24.0, u = z_mm - 20.0;
    const double r = radius_mm - 0.5 * crown * u * u, side = x_mm * std::sin(c_rad);
    stream.c_rad.push_back(c_rad);
    stream.position_mm.push_back(z_mm);
    stream.reading_mm.push_back(x_mm * std::cos(c_rad) + std::sqrt(r * r - side * side) +
                                2e-4 * std::sin(11.3 * i));
  }
  FitOptions options;
  options.profile = std::make_shared<Crowned>();
  const FitResult result = fit(stream, options);
  std::printf("%s after %d passes\n", to_string(result.status), result.iterations);
  for (const auto& [name, estimate] : result.parameters)
    std::printf("%-8s %12.7f ± %.1e %s\n", name.c_str(), estimate.value, 2 * estimate.u,
                estimate.unit.c_str());
  const Estimate& found = result.parameter("crown");
  return std::abs(found.value - crown) < 4.0 * found.u ? 0 : 1;
}
