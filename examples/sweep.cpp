// SPDX-License-Identifier: Apache-2.0
// Before measuring: how well will the axis be known, over the number of readings a turn? Bias and
// spread of 500 repeats next to the Cramér-Rao bound.
#include <cmath>
#include <cstdio>
#include <trueaxis/trueaxis.hpp>

using namespace trueaxis;

int main() {
  bool efficient = true;
  std::printf("   readings/rev   quantity   bias µm      sd µm   bound µm\n");
  for (const double readings : {8.0, 16.0, 32.0}) {
    virtual_lathe::Scenario scenario;
    scenario.part.radius_mm = 20.0;
    scenario.part.x0_mm = 0.1;
    virtual_lathe::PlannedPass pass;
    pass.end_mm = 40.0, pass.feed_mm_per_rev = 2.0, pass.readings_per_revolution = readings;
    scenario.plan.passes = {pass};
    scenario.noise.sigma_mm = 2e-3;
    for (const study::Spread& of : study::repeat(scenario, {.repeats = 500})) {
      if (of.name != "x0" && of.name != "radius") continue;
      std::printf("%15.0f   %-8s %9.4f %10.4f %10.4f\n", readings, of.name.c_str(), 1e3 * of.bias,
                  1e3 * of.sd, 1e3 * of.bound);
      efficient = efficient && std::abs(of.sd / of.bound - 1.0) < 0.15;  // 500 repeats: 3.2 % each
    }
  }
  return efficient ? 0 : 1;
}
