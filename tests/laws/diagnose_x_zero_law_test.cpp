// SPDX-License-Identifier: Apache-2.0
// A lathe's X = 0 is never on its spindle axis: what front and rear readings make of it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

/// Front and rear; the rear pass goes back where asked.
Scenario both_sides(PartKind kind, bool back) {
  Scenario scenario = probed_part(kind);
  scenario.noise.sigma_mm = 0.0005;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  PlannedPass rear = scenario.plan.passes[0];
  if (back) std::swap(rear.start_mm, rear.end_mm);
  rear.setup = 2;
  scenario.plan.passes.push_back(rear);
  Chucking second;
  second.number = 2, second.rear = true;
  scenario.plan.setups.push_back(second);
  return scenario;
}

Diagnosis diagnosed(const Scenario& scenario) {
  DiagnoseOptions options;
  options.fit.surface =
      scenario.part.kind == PartKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  options.threads = 1;
  return diagnose(simulate(scenario), options);
}

// 2 to 20 µm with 2400 readings of 0.5 µm: named alone, within 4 u (6e-5 of normal errors). On a
// cone a tilt of the probe and a slide out of parallel do the same together, but are two.
TEST(DiagnoseXZeroLaw, IsNamedFromBothSidesAndNothingElse) {
  for (const PartKind kind : {PartKind::cylinder, PartKind::cone})
    for (const bool back : {false, true})
      for (const double offset_mm : {0.002, -0.02}) {
        Scenario scenario = both_sides(kind, back);
        scenario.effects = {{"probe.x_zero", {{"offset_mm", offset_mm}}}};
        const Diagnosis found = diagnosed(scenario);
        ASSERT_EQ(found.findings.size(), 1U) << offset_mm << back;
        EXPECT_EQ(found.findings[0].effect(), "probe.x_zero");
        const Estimate& offset = found.findings[0].parameters[0].estimate;
        EXPECT_NEAR(offset.value, offset_mm, 4.0 * offset.u) << back;
        EXPECT_TRUE(found.unexplained.empty());
      }
}

// From one side it is the radius: nothing is found, and it is listed as hidden.
TEST(DiagnoseXZeroLaw, IsTheRadiusFromOneSide) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.noise.sigma_mm = 0.0005;
  scenario.effects = {{"probe.x_zero", {{"offset_mm", 0.02}}}};
  const Diagnosis found = diagnosed(scenario);
  EXPECT_TRUE(found.findings.empty());
  EXPECT_EQ(found.verdict, DiagnosisVerdict::ideal);
}

}  // namespace
}  // namespace trueaxis::testing
