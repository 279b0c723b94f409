// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

class DiagnosedSlip : public ::testing::TestWithParam<double> {};

// What a slip leaves of a turn rings with the spindle, so that an autoregression describes it as
// well as a step does; a large one was noise to it.
TEST_P(DiagnosedSlip, IsNoNoiseHoweverLarge) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.noise.sigma_mm = 0.002;
  scenario.plan.passes[0].end_mm = 30.0;
  scenario.plan.passes[0].feed_mm_per_rev = 1.0;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  const double dx = GetParam(), dy = 0.5 * GetParam();
  scenario.effects = {{"part.slip", {{"time_s", 12.0}, {"dx_mm", dx}, {"dy_mm", dy}}}};
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  options.threads = 1;
  const Diagnosis diagnosis = diagnose(simulate(scenario), options);
  const auto slip = std::ranges::find(diagnosis.findings, "part.slip", &Finding::effect);
  ASSERT_NE(slip, diagnosis.findings.end());
  // u of a step between halves of some 240 readings is σ √(2/240 + 2/240); and (dx² + dy²)/R of the
  // second order.
  const double u = scenario.noise.sigma_mm * std::sqrt(4.0 / 240.0);
  const double tolerance = 4.0 * u + (dx * dx + dy * dy) / scenario.part.radius_mm;
  for (const auto& [name, expected] : {std::pair{"dx", dx}, {"dy", dy}}) {
    const auto at = std::ranges::find(slip->parameters, name, &FitParameter::name);
    ASSERT_NE(at, slip->parameters.end()) << name;
    EXPECT_NEAR(at->estimate.value, expected, tolerance) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DiagnosedSlip, ::testing::Values(0.01, 0.03, 0.1, 0.3));

}  // namespace
}  // namespace trueaxis::testing
