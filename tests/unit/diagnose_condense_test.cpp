// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "diagnose/condense.hpp"
#include "support/diagnose_bench.hpp"
#include "support/diagnose_lathe.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

constexpr std::uint64_t seed = 6;
const testing::HelixPlan dense{.readings = 3000, .per_turn = 333.3, .passes = 2};

struct Dense {
  Scene scene = testing::bench_scene(dense, 0.1);
  Rows rows = make_rows(scene);
  std::vector<double> deviation = testing::white_noise(scene.size(), 5e-3, seed);
};

TEST(Condense, MeansKeepSumsPassesAndBlocks) {
  const Dense d;
  const Condensed means = condense(d.scene, d.rows, d.deviation, 8);
  EXPECT_EQ(means.scene.size(), 2u * 375u);
  double whole = 0.0, parts = 0.0;
  for (const double v : d.deviation) whole += v;
  for (const double v : means.deviation_mm) parts += 8.0 * v;
  EXPECT_NEAR(parts, whole, 1e-12);  // 6000 roundings of 5e-3
  ASSERT_EQ(means.scene.passes.size(), 2u);
  EXPECT_EQ(means.scene.passes[1].begin, 375u);
  EXPECT_NEAR(means.scene.passes[0].readings_per_revolution, 333.3 / 8.0, 0.05);
  EXPECT_EQ(means.rows.fold_begin.front(), 0u);
  EXPECT_EQ(means.rows.fold_begin.back(), 750u);
  // The middle of eight neighbours is 3.5 steps on, in C and along the part.
  EXPECT_NEAR(means.scene.c[10], d.scene.c[80] + 3.5 * two_pi / 333.3, 1e-9);
  // The tilt moves s by 40 mm × 1 mrad a turn; its curvature over eight steps is below 4e-5 mm.
  EXPECT_NEAR(means.scene.s[10], 0.5 * (d.scene.s[83] + d.scene.s[84]), 4e-5);
}

TEST(Condense, AnglesAreMeantAcrossTheTurn) {
  const Dense d;
  const Condensed means = condense(d.scene, d.rows, d.deviation, 8);
  for (std::size_t g = 0; g < means.scene.size(); ++g) {
    const std::size_t middle = 8 * g + 4;  // half a step on
    EXPECT_LT(std::abs(std::remainder(means.scene.theta[g] - d.scene.theta[middle], two_pi)),
              two_pi / 333.3);
  }
}

TEST(Condense, MaskedReadingsDoNotCount) {
  Dense d;
  for (const std::size_t i : {800, 801, 802, 803, 804, 1600}) d.rows.mask(i);
  d.deviation[800] = d.deviation[1600] = 1.0;
  d.rows.find_runs(d.scene);
  const Condensed means = condense(d.scene, d.rows, d.deviation, 8);
  for (const double v : means.deviation_mm) EXPECT_LT(std::abs(v), 0.02);
  // Of the group of 800 three are left: less than half. It starts anew behind them or not at all.
  std::size_t unused = 0;
  for (const char used : means.rows.used) unused += used == 0;
  EXPECT_EQ(unused, 1u);
}

TEST(Condense, OnlyDenseLongStreams) {
  const Scene few = testing::bench_scene({.readings = 3000, .per_turn = 333.3}, 0.1);
  EXPECT_EQ(condensation(few, resolution_of(few, make_rows(few))), 1u);
  const Scene many = testing::bench_scene({.readings = 70000, .per_turn = 333.3}, 0.1);
  EXPECT_EQ(condensation(many, resolution_of(many, make_rows(many))), 8u);
  const Scene sparse = testing::bench_scene({.readings = 70000, .per_turn = 23.7}, 0.1);
  EXPECT_EQ(condensation(sparse, resolution_of(sparse, make_rows(sparse))), 1u);
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
