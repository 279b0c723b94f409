// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "job/doubts.hpp"
#include "laws/turned_cylinder.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/units.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

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
  const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
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

// A part that slips by 4 deg turns its seven lobes by 28 deg of their own, and its axis with them.
// Before, the difference was vibrations and patterns without a cause in 8 of these 11 streams.
TEST(SlipThatTurns, TurnsTheFormOfThePart) {
  for (std::uint64_t seed = 2; seed <= 12; ++seed) {
    Scenario scenario = turned_cylinder(seed, 30.0, 0.0015);
    scenario.part.x0_mm = 0.4, scenario.part.y0_mm = -0.2;
    const double turn = 0.05 + 0.005 * static_cast<double>(seed), c = std::cos(turn),
                 s = std::sin(turn);
    scenario.effects = {
        {"part.slip", {{"time_s", 17.3}, {"turn_rad", turn}}},
        {"part.roundness", {{"order", 7.0}, {"amplitude_mm", 0.006}, {"phase_rad", double(seed)}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.findings.size(), 2U) << seed;
    EXPECT_TRUE(diagnosis.unexplained.empty()) << seed;
    // Eq. 46; the axis leans by 1 mrad at most, and what a turn changes of that over 30 mm is 3 µm.
    expect_axis_after(scenario, (c - 1.0) * 0.4 + s * 0.2, s * 0.4 - (c - 1.0) * 0.2, 0.0,
                      diagnosis);
  }
}

// A waviness that is long is the same all round the part, and the axis is stated. One of nearly the
// feed goes with the eccentricity: in 18 turns it loses 2.2 on it.
TEST(LongWaviness, LeavesTheAxisKnown) {
  for (const double wavelength_mm : {18.0, 12.0, 2.85}) {
    Scenario scenario = turned_cylinder(3, 20.0, 0.001);
    PlannedPass& pass = scenario.plan.passes[0];
    pass.start_mm = 0.0, pass.end_mm = 45.0, pass.feed_mm_per_rev = 2.5;
    scenario.effects = {
        {"part.waviness", {{"amplitude_mm", 0.003}, {"wavelength_mm", wavelength_mm}}}};
    const ProbeStream stream = simulate(scenario);
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    EXPECT_EQ(diagnosis.findings.size(), 1U) << wavelength_mm;
    EXPECT_EQ(why_axis_unknown(stream, diagnosis).has_value(), wavelength_mm < 3.0);
    if (wavelength_mm > 3.0) expect_axis_after(scenario, 0.0, 0.0, 45.0, diagnosis);
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
    EXPECT_TRUE(has_slip(diagnosed_cylinder(simulate(scenario)))) << "seed " << seed;
  }
}

// Two sizes of a step explain two readings of any errors: chips at the first or the last readings
// were a slip, and the axis went with it. 7 σ are below what is masked as an outlier by itself.
TEST(SlipAtAnEnd, IsNotMadeOfOutliersAtAnEnd) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Scenario scenario = turned_cylinder();
    scenario.seed = seed;
    ProbeStream stream = simulate(scenario);
    const FitResult clean = diagnosed_cylinder(stream).baseline;
    const std::size_t last = stream.size() - 1, begin = seed % 2 == 0 ? 0 : last - 1;
    stream.reading_mm[begin] += 7.0 * scenario.noise.sigma_mm;
    stream.reading_mm[begin + 1] += 7.0 * scenario.noise.sigma_mm;
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
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
  EXPECT_TRUE(has_slip(diagnosed_cylinder(simulate(scenario))));
}

// A slip δ leaves δ²/2R of the second order, 1 to 2.3 µm here with 0.5 µm of noise: lobes of the
// order 2 before it. They were named, a rival cause took its size from them, and the axis was 7 µm
// off with U 3 µm.
TEST(LargeSlip, IsExactToAllOrders) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario scenario = turned_cylinder(seed, 20.0, 0.0005);
    const double slip = 0.2 + 0.05 * static_cast<double>(seed % 3), towards = 1.1 * double(seed);
    const double dx = slip * std::cos(towards), dy = slip * std::sin(towards);
    scenario.effects = {{"part.slip", {{"time_s", 12.0}, {"dx_mm", dx}, {"dy_mm", dy}}},
                        {"part.barrel", {{"amplitude_mm", 0.006}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_TRUE(has_slip(diagnosis)) << "seed " << seed;
    EXPECT_EQ(diagnosis.findings.size(), 2U) << "seed " << seed;
    expect_axis_after(scenario, dx, dy, 30.0, diagnosis);
  }
}

// A part that moves by 0.3 mm between two passes leaves residuals of 0.1 mm that are all alike to
// their neighbours. By these its direction counted as not determined, "probe more of the length".
TEST(LargeSlip, BetweenPassesIsNoLackOfReadings) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Scenario scenario = turned_cylinder(seed, 27.3, 0.0005);
    PlannedPass again = scenario.plan.passes[0];
    again.pause_s = 20.0;
    scenario.plan.passes.push_back(again);
    const double end_s = simulate(scenario).time_s.back();
    const double dx = 0.3 * std::cos(double(seed)), dy = 0.3 * std::sin(double(seed));
    scenario.effects = {{"part.slip", {{"time_s", 0.5 * end_s}, {"dx_mm", dx}, {"dy_mm", dy}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.baseline.status, FitStatus::converged) << diagnosis.baseline.message;
    EXPECT_TRUE(has_slip(diagnosis)) << "seed " << seed;
    expect_axis_after(scenario, dx, dy, 30.0, diagnosis);
  }
}

// Between the places of a part that slipped by 0.15 mm in a second set-up, a barrel and a bent
// slide differ by what a tilt does: 1 mm of each was found, against the other. About the part after
// the slip they are one. The axis was 3 to 9 µm off, beyond 4 u, in each of four.
TEST(LargeSlip, InASecondSetUpIsSearchedAgain) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Scenario scenario = turned_cylinder(seed, 26.6, 0.0005);
    PlannedPass& out = scenario.plan.passes[0];
    out.end_mm = 17.8, out.feed_mm_per_rev = 0.65, out.readings_per_revolution = 30.2;
    PlannedPass back = out, again = out;
    std::swap(back.start_mm, back.end_mm);
    back.speed_rpm = 2.5 * out.speed_rpm, again.setup = 2;
    scenario.plan.passes.insert(scenario.plan.passes.end(), {back, again});
    Part& part = scenario.part;
    Chucking turned;
    turned.number = 2, turned.reindex_rad = 70.0 * rad_per_deg;
    turned.x0_mm = -0.006, turned.y0_mm = 0.009, turned.l = -4e-4, turned.m = 1e-4;
    scenario.plan.setups = {turned};
    const double until = simulate(scenario).time_s.back();
    scenario.effects = {
        {"part.slip", {{"time_s", until - 15.5}, {"dx_mm", -0.139}, {"dy_mm", 0.049}}},
        {"part.barrel", {{"amplitude_mm", 0.006}, {"cubic_mm", -0.001}}},
        {"part.roundness", {{"amplitude_mm", 0.005}, {"order", 2.0}, {"phase_rad", 2.8}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.extended.status, FitStatus::converged) << diagnosis.extended.message;
    EXPECT_TRUE(has_slip(diagnosis)) << "seed " << seed;
    part.x0_mm = *turned.x0_mm, part.y0_mm = *turned.y0_mm, part.l = *turned.l, part.m = *turned.m;
    expect_axis_after(scenario, -0.139, 0.049, 17.8, diagnosis);
  }
}

// What the interpolation of a scale leaves of a part that slipped has another phase before and
// after it. About the ideal fit eight to eleven other causes stood for it, and the axis was up
// to 2.2 µm off with U 0.5 µm.
TEST(LargeSlip, BesideTheErrorOfAScaleIsExchangedAboutThePart) {
  for (const std::uint64_t seed : {1}) {  // each takes as long as a hundred others
    Scenario scenario = turned_cylinder(seed, 21.8, 0.0006);
    scenario.part.x0_mm = 0.09, scenario.part.y0_mm = -0.12;
    PlannedPass& out = scenario.plan.passes[0];
    out.end_mm = 115.0, out.feed_mm_per_rev = 2.33, out.readings_per_revolution = 29.07;
    PlannedPass back = out;
    std::swap(back.start_mm, back.end_mm);
    back.speed_rpm = 2.5 * out.speed_rpm;
    scenario.plan.passes.push_back(back);
    const double on_the_way_back = 0.8 * simulate(scenario).time_s.back();
    scenario.effects = {
        {"part.slip", {{"time_s", on_the_way_back}, {"dx_mm", -0.077}, {"dy_mm", 0.087}}},
        {"probe.cyclic",
         {{"amplitude_mm", 0.002}, {"period_mm", 0.129}, {"phase_rad", double(seed)}}}};
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_EQ(diagnosis.findings.size(), 2U) << "seed " << seed;
    EXPECT_EQ(std::ranges::count(diagnosis.findings, "probe.cyclic", &Finding::effect), 1) << seed;
    expect_axis_after(scenario, -0.077, 0.087, 115.0, diagnosis);
  }
}

/// A part that slips by (12, 9) µm before a reading, probed in sections, one a second.
Scenario probed_in_sections(std::uint64_t seed, int sections, double per_turn, double reading) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.seed = seed;
  scenario.noise.sigma_mm = 0.001;
  scenario.plan.passes.clear();
  for (int k = 0; k < sections; ++k) {
    PlannedPass section;
    section.start_mm = section.end_mm = 40.0 * k / (sections - 1);
    section.readings_per_revolution = per_turn;
    section.revolutions = (per_turn - 1.0) / per_turn;
    section.pause_s = 1.0 / per_turn;
    section.c_start_rad = 0.0;
    scenario.plan.passes.push_back(section);
  }
  scenario.effects = {
      {"part.slip", {{"time_s", (reading - 0.5) / per_turn}, {"dx_mm", 0.012}, {"dy_mm", 0.009}}}};
  return scenario;
}

// The readings after the slip are of one section: they tell a shift and not a tilt as well. A fit
// of both ran away, and a local form without a cause took its place: the axis was off by the slip.
// 15 µm with u 1 µm √(4/18) are 30 u.
TEST(SlipInSections, IsFoundInTheLastOne) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scenario scenario = probed_in_sections(seed, 5, 36.0, 4 * 36 + 18);
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(scenario));
    EXPECT_TRUE(has_slip(diagnosis)) << "seed " << seed;
    expect_axis_after(scenario, 0.012, 0.009, 40.0, diagnosis);
  }
}

// Two of three sections say nothing about a bend, so that no block can speak against it. What is
// bent may then as well have slipped between two of them.
TEST(SlipInSections, MayBeABendOfThree) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Diagnosis diagnosis = diagnosed_cylinder(simulate(probed_in_sections(seed, 3, 24.0, 24)));
    EXPECT_TRUE(std::ranges::any_of(diagnosis.findings,
                                    [](const Finding& finding) {
                                      return finding.may_be("part.slip") &&
                                             finding.may_be("part.bow");
                                    }))
        << "seed " << seed;
  }
}

Scenario slow_pass(std::uint64_t seed, bool and_back) {
  Scenario scenario = probed_part(PartKind::cylinder);
  scenario.seed = seed;
  scenario.noise.sigma_mm = 0.001;
  PlannedPass& pass = scenario.plan.passes[0];
  pass.start_mm = 0.0, pass.end_mm = 60.0, pass.feed_mm_per_rev = 1.0;
  pass.readings_per_revolution = 24.37, pass.speed_rpm = 60.0;
  if (and_back) {
    PlannedPass back = pass;
    std::swap(back.start_mm, back.end_mm);
    scenario.plan.passes.push_back(back);
  }
  return scenario;
}

bool may_creep(const Finding& finding) { return finding.may_be("part.creep"); }

// A part that relaxes in its jaws, or cools, goes on in the whole pass. Its axis at the end is off
// the one that was fitted by more than the U of a bent part, which was named in 8 of 16. An
// axis that is given holds the place where the part is, at U of 95 %: 3 of 20 are out with a
// probability of 0.08, 4 with 0.016.
TEST(CreepOfAPart, IsNoBentPart) {
  constexpr int streams = 20;
  int out = 0, withheld = 0;
  for (int k = 0; k < streams; ++k) {
    Scenario scenario = slow_pass(static_cast<std::uint64_t>(k + 1), false);
    const double tau = k % 2 == 0 ? 20.0 : 12.0, towards = 0.7 * k;
    const double dx = 0.006 * std::cos(towards), dy = 0.006 * std::sin(towards);
    scenario.effects = {{"part.creep", {{"settling_s", tau}, {"dx_mm", dx}, {"dy_mm", dy}}}};
    ProbeStream stream = simulate(scenario);
    if (k % 4 == 3) stream.time_s.clear();  // then it goes with the number of the reading
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    if (why_axis_unknown(stream, diagnosis)) {
      ++withheld;
      continue;
    }
    const AxisEstimate& axis = diagnosis.extended.axis;
    const Part& part = scenario.part;
    const double moved = 1.0 - std::exp(-60.0 / tau),
                 n = std::sqrt(1.0 - part.l * part.l - part.m * part.m);
    bool holds = true;
    for (const double z : {0.0, 60.0}) {
      const auto at = axis.axis.at(z);
      const double off = std::hypot(at[0] - (part.x0_mm + moved * dx + z * part.l / n),
                                    at[1] - (part.y0_mm + moved * dy + z * part.m / n));
      holds = holds && off <= 2.0 * axis.u_at(z);
    }
    out += !holds;
  }
  RecordProperty("withheld", withheld);
  EXPECT_LE(out, 3) << withheld << " withheld";
  EXPECT_GT(withheld, streams / 2);  // 10 standard errors of the bend that it leaves
}

// A bend of 2 µm at 1 µm of noise is not a creep, which would have a half of it at
// twice its order, 10 standard errors off.
TEST(CreepOfAPart, IsNotWhatABentPartIsTakenFor) {
  int taken = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scenario scenario = slow_pass(seed, false);
    scenario.effects = {{"part.bow",
                         {{"sagitta_mm", 0.003},
                          {"length_mm", 60.0},
                          {"middle_mm", 30.0},
                          {"direction_rad", 0.5 * static_cast<double>(seed)}}}};
    const ProbeStream stream = simulate(scenario);
    taken += why_axis_unknown(stream, diagnosed_cylinder(stream)).has_value();
  }
  EXPECT_EQ(taken, 0);
}

// Evenly, in one pass, it is the tilt of an axis: the diagnosis says so, and there and back it is
// found.
TEST(CreepOfAPart, ThatIsEvenIsSaidToBeHiddenOrFound) {
  for (const bool and_back : {false, true}) {
    Scenario scenario = slow_pass(7, and_back);
    scenario.effects = {
        {"part.creep", {{"settling_s", 1e5}, {"dx_mm", 10.0}, {"dy_mm", 0.0}}}};  // 6 µm a minute
    const ProbeStream stream = simulate(scenario);
    const Diagnosis diagnosis = diagnosed_cylinder(stream);
    const bool hidden =
        std::ranges::count(diagnosis.not_observable, "part.creep", &NotObservable::effect) > 0;
    EXPECT_EQ(hidden, !and_back);
    EXPECT_EQ(why_axis_unknown(stream, diagnosis).has_value(), and_back);
    const auto found = std::ranges::find_if(diagnosis.findings, may_creep);
    ASSERT_EQ(found != diagnosis.findings.end(), and_back);
    if (and_back) {
      EXPECT_EQ(std::ranges::count(found->parameters, "settling", &FitParameter::name), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, DiagnosedSlip, ::testing::Values(0.01, 0.03, 0.1, 0.3));

}  // namespace
}  // namespace trueaxis::testing
