// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

/// A dial of 10 µm on a steady part, in five sections of the same eight angles.
Scenario probed_with_a_dial(int k) {
  Scenario scenario = probed_part(PartKind::cylinder);
  Part& part = scenario.part;
  part.x0_mm = 0.06 * std::cos(2.4 * k), part.y0_mm = 0.06 * std::sin(2.4 * k);
  part.l = 2e-4 * std::cos(1.7 * k), part.m = 2e-4 * std::sin(1.7 * k);
  part.radius_mm = 20.0 + 1.0037 * k;
  scenario.seed = static_cast<std::uint64_t>(k + 1);
  scenario.noise.sigma_mm = 3e-4;
  scenario.effects = {{"probe.quantisation", {{"step_mm", 0.01}}}};
  scenario.plan.passes.clear();
  for (int section = 0; section < 5; ++section) {
    PlannedPass pass;
    pass.start_mm = pass.end_mm = 8.0 * section;
    pass.readings_per_revolution = 8.0, pass.revolutions = 7.0 / 8.0, pass.pause_s = 1.0 / 8.0;
    pass.c_start_rad = 0.0;
    scenario.plan.passes.push_back(pass);
  }
  return scenario;
}

// Forty readings are hardly more than eight: where the axis hardly tilts, five have one error of
// rounding. As independent ones they gave u 1 µm where the root mean square error was 2 µm.
TEST(RoundedSections, HaveTheErrorsOfTheirAnglesInU) {
  constexpr int streams = 24;
  double square = 0.0, count = 0.0;
  for (int k = 0; k < streams; ++k) {
    const Scenario scenario = probed_with_a_dial(k);
    DiagnoseOptions options;
    options.fit.surface = SurfaceKind::cylinder;
    options.threads = 1;
    const Diagnosis diagnosis = diagnose(simulate(scenario), options);
    const Part& part = scenario.part;
    const double n = std::sqrt(1.0 - part.l * part.l - part.m * part.m);
    for (const double z_mm : {0.0, 32.0}) {
      const auto stated = diagnosis.extended.axis.axis.at(z_mm);
      const double u = diagnosis.extended.axis.u_at(z_mm);
      square += std::pow((stated[0] - part.x0_mm - part.l / n * z_mm) / u, 2) +
                std::pow((stated[1] - part.y0_mm - part.m / n * z_mm) / u, 2);
      count += 2.0;
    }
  }
  // Four errors of a stream count as two; with 48 in all, chi² is below 1.85 of its mean in all but
  // 1 of 2000.
  EXPECT_LT(square / count, 1.85);
}

}  // namespace
}  // namespace trueaxis::testing
