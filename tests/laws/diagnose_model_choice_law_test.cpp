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

// In few readings a form that readings may deviate by takes one that is 20 σ off at the end of its
// pass. With it that pass had slipped: 44 µm off at U 17 µm.
TEST(OutliersHiddenByAnEffect, AreExcludedAboutWhatWasFound) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Scenario scenario = turned_cylinder(seed, 36.9, 0.00125);
    scenario.u_end_mm = 44.0;
    PlannedPass out = scenario.plan.passes[0];
    out.start_mm = 0.0, out.end_mm = 44.0, out.feed_mm_per_rev = 15.5;
    out.readings_per_revolution = 14.8;
    PlannedPass back = out, rear = out, again = out;
    std::swap(back.start_mm, back.end_mm), std::swap(rear.start_mm, rear.end_mm);
    back.speed_rpm = 151.0;
    rear.setup = 2, again.setup = 3;
    scenario.plan.passes = {out, back, out, rear, again};
    Chucking turned, indexed;
    turned.number = 2, turned.rear = true;
    indexed.number = 3, indexed.reindex_rad = 1.2;
    scenario.plan.setups = {turned, indexed};
    scenario.effects = {
        {"slide.z_straightness", {{"amplitude_mm", 0.0115}, {"degree", 2.0}}},
        {"spindle.asynchronous",
         {{"order", 5.772}, {"amplitude_mm", 0.00185}, {"phase_rad", double(seed)}}}};
    ProbeStream stream = simulate(scenario);
    const std::size_t row = stream.size() - 1;
    stream.reading_mm[row - 1] -= 0.025;
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    EXPECT_TRUE(std::ranges::count(diagnosis.noise.masked, row, &Rejected::row)) << seed;
    EXPECT_FALSE(diagnosis.slip()) << seed;
    expect_axis_after(scenario, 0.0, 0.0, 44.0, diagnosis);
  }
}

// A digit typed wrong, 52 for 25 mm, moves the ideal fit of 200 readings by 0.3 mm. About that fit
// the second order of the eccentricity was two lobes or a curve in 12 of 40 streams without effect.
// What is found in noise is false: 1 % of 20 streams, at most 2 with a probability of 0.999.
TEST(ADigitTypedWrong, LeavesNoEffect) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scenario scenario = turned_cylinder(seed, 25.0, 0.002);
    scenario.plan.passes[0].feed_mm_per_rev = 2.0;
    scenario.plan.passes[0].readings_per_revolution = 20.0;
    ProbeStream stream = simulate(scenario);
    const std::size_t row = 9 * seed;
    ASSERT_LT(row, stream.size());
    stream.reading_mm[row - 1] += 27.0;
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    EXPECT_TRUE(std::ranges::count(diagnosis.noise.masked, row, &Rejected::row)) << seed;
    found += !diagnosis.findings.empty() || !diagnosis.unexplained.empty();
  }
  EXPECT_LE(found, 2);
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
// a bent slide do with three. So may a waviness of nearly the feed, half a cycle from the
// eccentricity. Before, 5 of these 16 had slipped, and in 5 more such a waviness left the axis
// 20 µm off at U 4 µm.
TEST(LastingSlip, IsNoBendOfAPart) {
  int slipped = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    Scenario scenario = turned_cylinder(seed, 37.0, 0.002);
    PlannedPass& pass = scenario.plan.passes[0];
    pass.start_mm = 0.0, pass.end_mm = 90.0, scenario.u_end_mm = 90.0;
    pass.feed_mm_per_rev = 20.0, pass.readings_per_revolution = 35.0;
    scenario.effects = {{"part.bow",
                         {{"sagitta_mm", 0.02},
                          {"direction_rad", 1.1 * double(seed)},
                          {"length_mm", 90.0},
                          {"middle_mm", 45.0},
                          {"share", 1.0 / 3.0}}},
                        {"slide.z_straightness", {{"amplitude_mm", 0.01}, {"degree", 4.0}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    slipped += diagnosis.slip() != nullptr;
    expect_axis_after(scenario, 0.0, 0.0, 90.0, diagnosis);
  }
  EXPECT_LE(slipped, 1);
}

// In two passes of two turns a barrel, a bend and a play of the slide hide each other: step by step
// all three were found in 6 of these 16 streams, and nothing in one, 11 µm off. All causes at once
// leave the noise alone, and what is not needed goes.
TEST(CausesThatHideEachOther, AreWhatIsLeftOfAll) {
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    Scenario scenario = turned_cylinder(seed, 21.0, 0.0011);
    scenario.u_end_mm = 16.6;
    PlannedPass out = scenario.plan.passes[0];
    out.start_mm = 0.0, out.end_mm = 16.6;
    out.feed_mm_per_rev = 7.7, out.readings_per_revolution = 26.0;
    PlannedPass back = out;
    std::swap(back.start_mm, back.end_mm);
    back.speed_rpm = 150.0;
    scenario.plan.passes = {out, back};
    scenario.effects = {{"part.bow",
                         {{"sagitta_mm", 0.012},
                          {"direction_rad", 0.9 * double(seed)},
                          {"length_mm", 16.6},
                          {"middle_mm", 8.3},
                          {"share", 1.0 / 3.0}}},
                        {"part.barrel", {{"amplitude_mm", 0.023}}},
                        {"slide.backlash", {{"across_mm", -0.0033}, {"along_mm", 0.0}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.findings.size(), 3U) << seed;
    EXPECT_TRUE(diagnosis.unexplained.empty()) << seed;
    expect_axis_after(scenario, 0.0, 0.0, 16.6, diagnosis);
  }
}

// A delay of 18 ms is 1.5 ms off in the first solution. That turns lobes of nine per revolution by
// 5 deg too far at 60/min and by 12 deg at 151/min. What it left was a slip, 6 µm off at U 0.7 µm.
TEST(DelayOfTheProbe, TurnsLobesByAsMuchAsWasFoundInTheEnd) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Scenario scenario = turned_cylinder(seed, 10.4, 0.0016);
    scenario.part.x0_mm = 0.2, scenario.part.y0_mm = 0.1;
    PlannedPass fast = scenario.plan.passes[0];
    std::swap(fast.start_mm, fast.end_mm);
    fast.speed_rpm = 151.0;
    scenario.plan.passes.push_back(fast);
    PlannedPass there = scenario.plan.passes[0], stands;
    there.start_mm = there.end_mm = stands.start_mm = stands.end_mm = 15.0;
    there.revolutions = 20.0;
    stands.speed_rpm = 0.0, stands.duration_s = 10.0, stands.rate_hz = 30.0;
    scenario.plan.passes.push_back(there), scenario.plan.passes.push_back(stands);
    const double delay = 0.018 + 0.002 * static_cast<double>(seed);
    scenario.effects = {
        {"probe.latency", {{"delay_s", delay}}},
        {"spindle.tilt_synchronous",
         {{"order", 9.0}, {"amplitude_rad", 4.7e-5}, {"bearing_mm", -300.0}, {"phase_rad", 1.0}}},
        {"spindle.asynchronous",
         {{"order", 6.14}, {"amplitude_mm", 0.00065}, {"phase_rad", double(seed)}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.findings.size(), 3U) << "seed " << seed;
    expect_axis_after(scenario, 0.0, 0.0, 30.0, diagnosis);
  }
}

}  // namespace
}  // namespace trueaxis::testing
