// SPDX-License-Identifier: Apache-2.0
// Causes that agree with each other and with what a sensor can be: on the virtual lathe.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "support/diagnose_lathe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

using virtual_lathe::Scenario;

/// A shaft 15 µm off whose lobes of the orders 2 and 3 are in phase with that.
Scenario in_phase(double second_mm, double third_mm, std::uint64_t seed) {
  Scenario scenario = one_pass(0.0, 40.0, 1e-3);
  scenario.seed = seed;
  auto& part = scenario.part;
  part.x0_mm = 0.012, part.y0_mm = 0.009, part.l = part.m = 0.0;
  const double phase = std::atan2(part.y0_mm, part.x0_mm);
  scenario.effects = {
      {"part.roundness", {{"order", 2}, {"amplitude_mm", second_mm}, {"phase_rad", 2 * phase}}},
      {"part.roundness", {{"order", 3}, {"amplitude_mm", third_mm}, {"phase_rad", 3 * phase}}}};
  return scenario;
}

// No sensor bends by a third of the range that it is used over: they are lobes, and the axis does
// not follow a sensor that would be broken.
TEST(AgreeingCauses, LobesInPhaseWithTheEccentricityAreNoSensor) {
  for (const double times : {0.3, 1.0, 3.0}) {
    SCOPED_TRACE(times);
    const Scenario scenario = in_phase(3e-3 * times, 2e-3 * times, 5);
    const Diagnosis found = diagnose(virtual_lathe::simulate(scenario), on_one_core(scenario));
    for (const Finding& f : found.findings) {
      EXPECT_FALSE(f.may_be("probe.nonlinearity")) << f.effect();
      EXPECT_FALSE(f.may_be("probe.cyclic")) << f.effect();
    }
    EXPECT_NE(finding_with(found, "part.roundness"), nullptr);
    for (const double z_mm : {0.0, 60.0}) {
      const auto axis = found.extended.axis.axis.at(z_mm);
      const double off_mm =
          std::hypot(axis[0] - scenario.part.x0_mm, axis[1] - scenario.part.y0_mm);
      const double u_mm = found.extended.axis.u_at(z_mm);
      EXPECT_LT(off_mm, 3.0 * u_mm);
      EXPECT_LT(u_mm, 2e-3) << "what is known of the axis is not thrown away";
    }
  }
}

/// A spindle that tilts in three lobes about a bearing, and a long part.
Diagnosis of_tilt(double bearing_mm) {
  Scenario scenario = one_pass(0.0, 50.0, 1e-3);
  scenario.seed = 7;
  scenario.plan.passes[0].end_mm = 200.0, scenario.plan.passes[0].feed_mm_per_rev = 4.0;
  scenario.plan.passes[0].readings_per_revolution = 36.7;
  scenario.u_end_mm = 200.0;
  scenario.effects = {
      {"spindle.tilt_synchronous",
       {{"order", 3}, {"amplitude_rad", 3e-5}, {"bearing_mm", bearing_mm}, {"phase_rad", 0.7}}}};
  return diagnose(virtual_lathe::simulate(scenario), on_one_core(scenario));
}

// The columns of lobes that grow along the part hold those of a tilt, wherever its bearing is: no
// reading tells them apart, and none of both may be dropped.
TEST(AgreeingCauses, ATiltSharesItsClassWithLobesThatGrow) {
  for (const double bearing_mm : {-250.0, -60.0, 30.0, 90.0, 150.0}) {
    SCOPED_TRACE(bearing_mm);
    const Diagnosis found = of_tilt(bearing_mm);
    const Finding* tilt = finding_with(found, "spindle.tilt_synchronous");
    ASSERT_NE(tilt, nullptr);
    EXPECT_TRUE(tilt->may_be("part.roundness"));
    double least = tilt->probability;
    for (const Rival& r : tilt->rivals) {
      std::cout << bearing_mm << ' ' << r.effect << ' ' << r.probability << '\n';
      if (r.distance < 1.0) least = std::min(least, r.probability);
    }
    EXPECT_GE(least, 0.02);
  }
}

}  // namespace
}  // namespace trueaxis::testing
