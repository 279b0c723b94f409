// SPDX-License-Identifier: Apache-2.0
// A drift, a slide out of parallel and a taper are one from the front side. The pass from the rear
// side that the advice gives, made by the lathe, tells them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

/// Front only: 50 revolutions in 50 s, 30 mm along Z.
Scenario from_the_front(PartKind kind) {
  Scenario scenario = probed_part(kind);
  scenario.noise.sigma_mm = 0.0005;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  return scenario;
}

Diagnosis told_of(const Scenario& scenario) {
  DiagnoseOptions options;
  options.fit.surface =
      scenario.part.kind == PartKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  options.threads = 1;
  return diagnose(simulate(scenario), options);
}

/// The scenario with the rear side probed as the words of the plan say.
Scenario from_the_rear_too(Scenario scenario, const std::string& words) {
  PlannedPass rear = scenario.plan.passes[0];
  rear.setup = 2;
  double from = 0.0, to = 0.0;
  if (std::sscanf(words.c_str(), "probe from the rear side, from Z %lf to %lf mm and back", &from,
                  &to) == 2) {
    std::swap(rear.start_mm, rear.end_mm);
    EXPECT_NEAR(from, rear.start_mm, 0.01);
    EXPECT_NEAR(to, rear.end_mm, 0.01);
    scenario.plan.passes.push_back(rear);
    std::swap(rear.start_mm, rear.end_mm);
  }
  scenario.plan.passes.push_back(rear);
  Chucking second;
  second.number = 2, second.rear = true;
  scenario.plan.setups.push_back(second);
  return scenario;
}

// The effect is 4 µm over the pass, and σ 0.5 µm: with 1200 readings a pass each of the slopes is
// known to 0.05 µm, 80 times less.
TEST(AdvisedRearPass, TellsADriftFromASlideOutOfParallel) {
  const virtual_lathe::Effect effects[] = {{"thermal.drift", {{"rate_mm_per_s", 8e-5}}},
                                           {"slide.xz_parallelism", {{"slope_rad", 1.33e-4}}}};
  for (const PartKind kind : {PartKind::cylinder, PartKind::cone})
    for (const virtual_lathe::Effect& effect : effects) {
      Scenario scenario = from_the_front(kind);
      scenario.effects = {effect};
      const Diagnosis before = told_of(scenario);
      const auto plan = std::ranges::find(before.plans, "RE", &Separating::plan);
      ASSERT_NE(plan, before.plans.end());
      const Diagnosis after = told_of(from_the_rear_too(scenario, plan->what));
      std::cout << plan->what << ", seed " << scenario.seed << '\n';
      ASSERT_EQ(after.findings.size(), 1U) << effect.id;
      EXPECT_EQ(after.findings[0].effect(), effect.id);
    }
}

}  // namespace
}  // namespace trueaxis::testing
