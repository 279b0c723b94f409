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

Scenario turned_cylinder() {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.noise.sigma_mm = 0.002;
  scenario.plan.passes[0].end_mm = 30.0;
  scenario.plan.passes[0].feed_mm_per_rev = 1.0;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  return scenario;
}

Diagnosis diagnosed(const ProbeStream& stream) {
  DiagnoseOptions options;
  options.fit.surface = SurfaceKind::cylinder;
  options.threads = 1;
  return diagnose(stream, options);
}

bool has_slip(const Diagnosis& diagnosis) {
  return std::ranges::count(diagnosis.findings, "part.slip", &Finding::effect) > 0;
}

class DiagnosedSlip : public ::testing::TestWithParam<double> {};

// What a slip leaves of a turn rings with the spindle, so that an autoregression describes it as
// well as a step does; a large one was noise to it.
TEST_P(DiagnosedSlip, IsNoNoiseHoweverLarge) {
  Scenario scenario = turned_cylinder();
  const double dx = GetParam(), dy = 0.5 * GetParam();
  scenario.effects = {{"part.slip", {{"time_s", 12.0}, {"dx_mm", dx}, {"dy_mm", dy}}}};
  const Diagnosis diagnosis = diagnosed(simulate(scenario));
  const auto slip = std::ranges::find(diagnosis.findings, "part.slip", &Finding::effect);
  ASSERT_NE(slip, diagnosis.findings.end());
  // u of a step between halves of some 240 readings is σ √(2/240 + 2/240), and twice that if the
  // tilt may step too: a line is known half as well at its end. And (dx² + dy²)/R of the second
  // order.
  const double u = 2.0 * scenario.noise.sigma_mm * std::sqrt(4.0 / 240.0);
  const double tolerance = 4.0 * u + (dx * dx + dy * dy) / scenario.part.radius_mm;
  for (const auto& [name, expected] : {std::pair{"dx", dx}, {"dy", dy}}) {
    const auto at = std::ranges::find(slip->parameters, name, &FitParameter::name);
    ASSERT_NE(at, slip->parameters.end()) << name;
    EXPECT_NEAR(at->estimate.value, expected, tolerance) << name;
  }
}

// The readings right at a step are predicted across it, and one large innovation of the noise looks
// the same there. A slip also shows in what follows: 240 readings a side with ρ = 0.8 tell as much
// as 27 independent ones, so that a step of 5 σ is one of 18 standard errors.
TEST(SlipInCorrelatedNoise, ShowsInTheLevel) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scenario scenario = turned_cylinder();
    scenario.seed = seed, scenario.noise.rho = 0.8;
    scenario.effects = {{"part.slip", {{"time_s", 12.0}, {"dx_mm", 0.01}}}};
    EXPECT_TRUE(has_slip(diagnosed(simulate(scenario)))) << "seed " << seed;
  }
}

// Two sizes of a step explain two readings of any errors: chips at the first or the last readings
// were a slip, and the axis went with it. 7 σ are below what is masked as an outlier by itself.
TEST(SlipAtAnEnd, IsNotMadeOfOutliersAtAnEnd) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Scenario scenario = turned_cylinder();
    scenario.seed = seed;
    ProbeStream stream = simulate(scenario);
    const FitResult clean = diagnosed(stream).baseline;
    const std::size_t last = stream.size() - 1, begin = seed % 2 == 0 ? 0 : last - 1;
    stream.reading_mm[begin] += 7.0 * scenario.noise.sigma_mm;
    stream.reading_mm[begin + 1] += 7.0 * scenario.noise.sigma_mm;
    const Diagnosis diagnosis = diagnosed(stream);
    EXPECT_FALSE(has_slip(diagnosis)) << "seed " << seed;
    // The axis is that of the stream without them, within 4 u (one of 16 000 is not).
    const auto stated = diagnosis.extended.axis.axis.at(15.0), without = clean.axis.axis.at(15.0);
    for (const std::size_t k : {0U, 1U})
      EXPECT_NEAR(stated[k], without[k], 4.0 * diagnosis.extended.axis.u_at(15.0)) << seed;
  }
}

// One that leaves a turn after it is a slip still: with 6 σ, λ is above 24 / 2 · 6² = 430.
TEST(SlipAtAnEnd, IsSeenATurnBeforeTheEnd) {
  Scenario scenario = turned_cylinder();
  const double per_s = simulate(scenario).time_s[1];
  const double last_s = simulate(scenario).time_s.back();
  scenario.effects = {
      {"part.slip", {{"time_s", last_s - 23.5 * per_s}, {"dx_mm", 0.012}, {"dy_mm", 0.0}}}};
  EXPECT_TRUE(has_slip(diagnosed(simulate(scenario))));
}

INSTANTIATE_TEST_SUITE_P(Sizes, DiagnosedSlip, ::testing::Values(0.01, 0.03, 0.1, 0.3));

}  // namespace
}  // namespace trueaxis::testing
