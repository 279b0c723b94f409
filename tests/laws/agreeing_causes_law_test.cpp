// SPDX-License-Identifier: Apache-2.0
// Causes that no reading tells apart share a class, on the virtual lathe.
#include <gtest/gtest.h>

#include <iostream>

#include "support/diagnose_lathe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

using virtual_lathe::Scenario;

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
  for (const double bearing_mm : {-60.0, 30.0, 90.0, 150.0}) {
    SCOPED_TRACE(bearing_mm);
    const Diagnosis found = of_tilt(bearing_mm);
    const Finding* tilt = finding_with(found, "spindle.tilt_synchronous");
    ASSERT_NE(tilt, nullptr);
    std::cout << bearing_mm << ": " << tilt->effect() << ' ' << tilt->probability << '\n';
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
