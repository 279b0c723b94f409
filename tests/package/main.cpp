// SPDX-License-Identifier: Apache-2.0
// A user's program: public headers and one library, nothing of what is behind them.
#include <cmath>
#include <cstdio>

#include "trueaxis/fit.hpp"

int main() {
  trueaxis::ProbeStream stream;
  for (int i = 0; i < 24; ++i) {  // a circle of 10 mm, 0.1 mm off along X; two sections
    const double c_rad = 0.3 * i, side = 0.1 * std::sin(c_rad);
    stream.c_rad.push_back(c_rad);
    stream.position_mm.push_back(i % 2 == 0 ? 0.0 : 5.0);
    stream.reading_mm.push_back(0.1 * std::cos(c_rad) + std::sqrt(100.0 - side * side));
  }
  trueaxis::FitOptions options;
  options.surface = "cylinder";
  const trueaxis::FitResult result = trueaxis::fit(stream, options);
  const double x_mm = result.axis.axis.at(0.0)[0];
  std::printf("%s, x0 = %.9f mm\n", trueaxis::to_string(result.status), x_mm);
  return result.status == trueaxis::FitStatus::converged && std::abs(x_mm - 0.1) < 1e-9 ? 0 : 1;
}
