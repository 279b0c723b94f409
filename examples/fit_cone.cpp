// SPDX-License-Identifier: Apache-2.0
// A cone is fitted to readings along X while the spindle turns: here those of a cone 50 µm off.
#include <cmath>
#include <cstdio>
#include <trueaxis/trueaxis.hpp>

int main() {
  trueaxis::ProbeStream stream;  // X_M, C and Z, one entry a reading; mm and rad
  for (int i = 0; i < 400; ++i) {
    const double c_rad = 0.6 * i, z_mm = 0.1 * i, waviness_mm = 1e-3 * std::sin(7.7 * i);
    stream.c_rad.push_back(c_rad);
    stream.position_mm.push_back(z_mm);
    stream.reading_mm.push_back(25.0 + z_mm / 8.0 + 0.05 * std::cos(c_rad) + waviness_mm);
  }
  trueaxis::FitOptions options;
  options.surface = trueaxis::SurfaceKind::cone;
  const trueaxis::FitResult result = trueaxis::fit(stream, options);
  for (const auto& [name, inside] : result.parameters) {
    const trueaxis::Estimate at_edge = trueaxis::at_edge(inside);  // degrees for rad
    std::printf("%-10s %11.6f ± %.6f %s\n", name.c_str(), at_edge.value, 2.0 * at_edge.u,
                at_edge.unit.c_str());
  }
}
