// SPDX-License-Identifier: Apache-2.0
// Causes that no reading tells apart share a class, on the virtual lathe.
#include <gtest/gtest.h>

#include <iostream>

#include "support/diagnose_lathe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

using virtual_lathe::Scenario;

Diagnosis of_long_part(std::vector<virtual_lathe::Effect> effects) {
  Scenario scenario = one_pass(0.0, 50.0, 1e-3);
  scenario.seed = 7;
  scenario.plan.passes[0].end_mm = 200.0, scenario.plan.passes[0].feed_mm_per_rev = 4.0;
  scenario.plan.passes[0].readings_per_revolution = 36.7;
  scenario.u_end_mm = 200.0;
  scenario.effects = std::move(effects);
  return diagnose(virtual_lathe::simulate(scenario), on_one_core(scenario));
}

/// A spindle that tilts in three lobes about a bearing.
Diagnosis of_tilt(double bearing_mm) {
  return of_long_part(
      {{"spindle.tilt_synchronous",
        {{"order", 3}, {"amplitude_rad", 3e-5}, {"bearing_mm", bearing_mm}, {"phase_rad", 0.7}}}});
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

// Lobes that shrink along the part are nearly those that decay from the jaws.
TEST(AgreeingCauses, LobesThatShrinkMayBeThePart) {
  const Diagnosis found = of_long_part(
      {{"part.roundness",
        {{"order", 3}, {"amplitude_mm", 5e-3}, {"growth_mm", -2e-3}, {"phase_rad", 0.7}}}});
  ASSERT_EQ(found.findings.size(), 1u);
  double part =
      found.findings[0].effect() == "part.roundness" ? found.findings[0].probability : 0.0;
  for (const Rival& r : found.findings[0].rivals)
    if (r.effect == "part.roundness") part = r.probability;
  EXPECT_GE(part, 0.02);
}

// No order of a crude part is given to the spindle for a growth that is small for its lobes.
TEST(AgreeingCauses, AllOrdersOfACrudePartAreOfThePart) {
  const auto lobes = [](double order, double mm, double phase) {
    return virtual_lathe::Effect{"part.roundness",
                                 {{"order", order}, {"amplitude_mm", mm}, {"phase_rad", phase}}};
  };
  const auto growth = [](double order, double mm, double phase) {
    return virtual_lathe::Effect{
        "part.roundness",
        {{"order", order}, {"amplitude_mm", 0.0}, {"growth_mm", mm}, {"phase_rad", phase}}};
  };
  const Diagnosis found =
      of_long_part({lobes(2, 0.05, 0.3), growth(2, 0.006, 1.9), lobes(3, 0.04, 1.0),
                    growth(3, 0.005, 2.5), lobes(4, 0.03, 2.0), growth(4, 0.004, 3.4)});
  int orders = 0;
  for (const Finding& finding : found.findings) {
    double spindle = 0.0;
    const auto count = [&](std::string_view id, double probability) {
      if (id.starts_with("spindle.")) spindle += probability;
    };
    count(finding.effect(), finding.probability);
    for (const Rival& r : finding.rivals) count(r.effect, r.probability);
    EXPECT_LT(spindle, 0.5) << finding.effect();
    orders += finding.may_be("part.roundness") ? 1 : 0;
  }
  EXPECT_GE(orders, 3);
}

}  // namespace
}  // namespace trueaxis::testing
