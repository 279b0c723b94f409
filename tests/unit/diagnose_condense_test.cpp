// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "diagnose/geometry/condense.hpp"
#include "support/diagnose_bench.hpp"
#include "support/diagnose_lathe.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

constexpr std::uint64_t seed = 6;
const testing::HelixPlan dense{.readings = 3000, .per_turn = 333.3, .passes = 2};

struct Dense {
  LinearisationPoint point = testing::bench_point(dense, 0.1);
  ObservationMask mask = make_observation_mask(point);
  std::vector<double> deviation = testing::white_noise(point.size(), 5e-3, seed);
};

TEST(Condense, MeansKeepSumsPassesAndBlocks) {
  const Dense d;
  const Condensed means = condense(d.point, d.mask, d.deviation, 8);
  EXPECT_EQ(means.point.size(), 2u * 375u);
  double whole = 0.0, parts = 0.0;
  for (const double v : d.deviation) whole += v;
  for (const double v : means.deviation_mm) parts += 8.0 * v;
  EXPECT_NEAR(parts, whole, 1e-12);  // 6000 roundings of 5e-3
  ASSERT_EQ(means.point.passes.size(), 2u);
  EXPECT_EQ(means.point.passes[1].begin, 375u);
  EXPECT_NEAR(means.point.passes[0].readings_per_revolution, 333.3 / 8.0, 0.05);
  EXPECT_EQ(means.mask.fold_begin.front(), 0u);
  EXPECT_EQ(means.mask.fold_begin.back(), 750u);
  // The middle of eight neighbours is 3.5 steps on, in C and along the part.
  EXPECT_NEAR(means.point.c[10], d.point.c[80] + 3.5 * two_pi / 333.3, 1e-9);
  // The tilt moves s by 40 mm × 1 mrad a turn; its curvature over eight steps is below 4e-5 mm.
  EXPECT_NEAR(means.point.s[10], 0.5 * (d.point.s[83] + d.point.s[84]), 4e-5);
}

TEST(Condense, AnglesAreMeantAcrossTheTurn) {
  const Dense d;
  const Condensed means = condense(d.point, d.mask, d.deviation, 8);
  for (std::size_t g = 0; g < means.point.size(); ++g) {
    const std::size_t middle = 8 * g + 4;  // half a step on
    EXPECT_LT(std::abs(std::remainder(means.point.theta[g] - d.point.theta[middle], two_pi)),
              two_pi / 333.3);
  }
}

TEST(Condense, MaskedReadingsDoNotCount) {
  Dense d;
  for (const std::size_t i : {800, 801, 802, 803, 804, 1600}) d.mask.mask(i);
  d.deviation[800] = d.deviation[1600] = 1.0;
  d.mask.find_runs(d.point);
  const Condensed means = condense(d.point, d.mask, d.deviation, 8);
  for (const double v : means.deviation_mm) EXPECT_LT(std::abs(v), 0.02);
  // Of the group of 800 three are left: less than half. It starts anew behind them or not at all.
  std::size_t unused = 0;
  for (const char used : means.mask.used) unused += used == 0;
  EXPECT_EQ(unused, 1u);
}

TEST(Condense, OnlyDenseLongStreams) {
  const LinearisationPoint few = testing::bench_point({.readings = 3000, .per_turn = 333.3}, 0.1);
  EXPECT_EQ(condensation(few, resolution_of(few, make_observation_mask(few))), 1u);
  const LinearisationPoint many = testing::bench_point({.readings = 70000, .per_turn = 333.3}, 0.1);
  EXPECT_EQ(condensation(many, resolution_of(many, make_observation_mask(many))), 8u);
  const LinearisationPoint sparse =
      testing::bench_point({.readings = 70000, .per_turn = 23.7}, 0.1);
  EXPECT_EQ(condensation(sparse, resolution_of(sparse, make_observation_mask(sparse))), 1u);
}

/// λ = N A²/(2σ²) = 170 either way (threshold 28): what is slow is found in the means, what is
/// faster than they are in all readings.
class LongStream : public ::testing::TestWithParam<const char*> {};

TEST_P(LongStream, ItsLineIsFound) {
  std::cout << "seed " << seed << '\n';
  const std::string id = GetParam();
  virtual_lathe::Scenario scenario = testing::one_pass(0.1, 200.0, 5e-3);
  scenario.seed = seed;
  scenario.plan.passes[0].readings_per_revolution = 333.3;
  scenario.plan.passes[0].speed_rpm = 600.0;
  const double amplitude_mm = 5e-3 * std::sqrt(2.0 * 170.0 / (200.0 * 333.3));
  if (id == "part.roundness")
    scenario.effects = {{id, {{"order", 3.0}, {"amplitude_mm", amplitude_mm}, {"phase_rad", 0.7}}}};
  else
    scenario.effects = {
        {id, {{"frequency_hz", 312.7}, {"amplitude_mm", amplitude_mm}, {"phase_rad", 0.7}}}};
  const Diagnosis found =
      diagnose(virtual_lathe::simulate(scenario), testing::on_one_core(scenario));
  ASSERT_EQ(found.findings.size(), 1u);
  const Finding* f = testing::finding_with(found, id);
  ASSERT_NE(f, nullptr);
  const Estimate* amplitude = testing::parameter_of(*f, "amplitude");
  ASSERT_NE(amplitude, nullptr);
  EXPECT_NEAR(amplitude->value, amplitude_mm, 4.0 * amplitude->u);
}

INSTANTIATE_TEST_SUITE_P(Lines, LongStream,
                         ::testing::Values("part.roundness", "environment.vibration"));

}  // namespace
}  // namespace trueaxis
