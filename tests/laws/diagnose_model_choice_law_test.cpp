// SPDX-License-Identifier: Apache-2.0
// What the search finds step by step is weighed as a whole: against noise alone, against a part
// that did not slip, without readings that it left far off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laws/turned_cylinder.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

// Readings of a bent slide spread by 10 µm, so that one 30 µm off is not far out among them: 24 σ
// about what was found. With two of them in the last pass that pass had slipped, 44 µm off.
TEST(OutliersHiddenByAnEffect, AreExcludedAboutWhatWasFound) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario scenario = turned_cylinder(seed, 25.0, 0.00125);
    scenario.plan.passes[0].feed_mm_per_rev = 6.0;
    scenario.effects = {{"slide.z_straightness", {{"amplitude_mm", 0.02}, {"degree", 2.0}}}};
    scenario.plan.passes.assign(3, scenario.plan.passes[0]);
    std::swap(scenario.plan.passes[1].start_mm, scenario.plan.passes[1].end_mm);
    ProbeStream stream = simulate(scenario);
    const std::size_t first = stream.size() - 70 - 3 * seed, second = stream.size() - 20 + seed;
    stream.reading_mm[first] -= 0.03, stream.reading_mm[second] += 0.03;
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    for (const std::size_t row : {first + 1, second + 1})
      EXPECT_TRUE(std::ranges::count(diagnosis.noise.masked, row, &Rejected::row)) << seed;
    EXPECT_EQ(diagnosis.noise.masked.size(), 2U) << seed;
    EXPECT_EQ(diagnosis.findings.size(), 1U) << seed;
    expect_axis_after(scenario, 0.0, 0.0, 30.0, diagnosis);
  }
}

// A hundred readings of a noise that remembers, ρ = 0.8, tell as much as eleven. Slips, slow
// vibrations and lobes described them to half their σ, and the axis was 5 U off. What is found in
// noise is false: 1 % of 40 streams, at most 3 with a probability of 0.999.
TEST(CorrelatedNoise, IsNotDescribedByCauses) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Scenario scenario = turned_cylinder(seed, 55.0, 0.0005);
    scenario.noise.rho = 0.8;
    scenario.plan.passes[0].feed_mm_per_rev = 6.0;
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    found += !diagnosis.findings.empty() || !diagnosis.unexplained.empty();
  }
  EXPECT_LE(found, 3);
}

// Half of a short capture may be a slip that takes its time: with six sizes it does what a bend and
// a bent slide do with three.
TEST(LastingSlip, IsNoBendOfAPart) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario scenario = turned_cylinder(seed, 37.0, 0.002);
    scenario.plan.passes[0].start_mm = 0.0, scenario.plan.passes[0].end_mm = 90.0;
    scenario.plan.passes[0].feed_mm_per_rev = 10.0;
    scenario.plan.passes[0].readings_per_revolution = 35.0;
    scenario.u_end_mm = 90.0;
    scenario.effects = {{"part.bow",
                         {{"sagitta_mm", 0.02},
                          {"direction_rad", 1.1 * double(seed)},
                          {"length_mm", 90.0},
                          {"middle_mm", 45.0},
                          {"share", 1.0 / 3.0}}},
                        {"slide.z_straightness", {{"amplitude_mm", 0.01}, {"degree", 4.0}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_FALSE(diagnosis.slip()) << "seed " << seed;
    expect_axis_after(scenario, 0.0, 0.0, 90.0, diagnosis);
  }
}

// A delay of 15 ms that is found as 16.5 ms at first turns lobes of nine per revolution by 5 deg
// too far at 60/min and by 12 deg at 150/min. What that leaves was a slip, 6 µm off at U 0.7 µm.
TEST(DelayOfTheProbe, TurnsLobesByAsMuchAsWasFoundInTheEnd) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scenario scenario = turned_cylinder(seed, 10.4, 0.0016);
    scenario.part.x0_mm = 0.2, scenario.part.y0_mm = 0.1;
    PlannedPass fast = scenario.plan.passes[0];
    std::swap(fast.start_mm, fast.end_mm);
    fast.speed_rpm = 151.0;
    scenario.plan.passes.push_back(fast);
    const double delay = 0.014 + 0.001 * static_cast<double>(seed);
    scenario.effects = {
        {"probe.latency", {{"delay_s", delay}}},
        {"spindle.tilt_synchronous",
         {{"order", 9.0}, {"amplitude_rad", 4.7e-5}, {"bearing_mm", -300.0}, {"phase_rad", 1.0}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.findings.size(), 2U) << "seed " << seed;
    expect_axis_after(scenario, 0.0, 0.0, 30.0, diagnosis);
    const double sigma = 0.0016;
    EXPECT_NEAR(diagnosis.noise.sigma_mm, sigma,
                4.0 * sigma / std::sqrt(2.0 * static_cast<double>(diagnosis.baseline.points)))
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace trueaxis::testing
