// SPDX-License-Identifier: Apache-2.0
// The virtual lathe at the arguments of a recorded stream against the same lathe with a plan: where
// the stream is what the plan recorded, the readings are the plan's.
#include <gtest/gtest.h>

#include <cmath>

#include "simulate/clean_stream.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::virtual_lathe {
namespace {

Scenario two_set_ups() {
  Scenario scenario;
  scenario.part.kind = PartKind::cone;
  scenario.part.radius_mm = 40.0;
  scenario.part.half_angle_rad = 0.1;
  scenario.part.x0_mm = 0.2;
  scenario.part.m = 1e-3;
  PlannedPass out;
  out.end_mm = 30.0;
  out.feed_mm_per_rev = 1.7;
  out.readings_per_revolution = 31.3;
  PlannedPass back = out;
  back.start_mm = 30.0, back.end_mm = 0.0, back.speed_rpm = -151.0, back.setup = 2;
  scenario.plan.passes = {out, back};
  Chucking second;
  second.number = 2, second.reindex_rad = 0.9, second.x_jog_mm = 0.1;
  second.l = -1e-3, second.m = 5e-4, second.x0_mm = -0.1, second.y0_mm = 0.3;
  scenario.plan.setups = {second};
  scenario.u_start_mm = 0.0;
  scenario.u_end_mm = 30.0;
  scenario.noise.sigma_mm = 0.002;
  scenario.noise.autoregression = {0.5, 0.3};
  scenario.seed = 77;
  return scenario;
}

void expect_the_plans_readings(const Scenario& scenario, double tolerance_mm) {
  const Simulation planned = simulate_with_truth(scenario);
  const Simulation again = simulate_at(scenario, planned.stream);
  ASSERT_EQ(again.stream.size(), planned.stream.size());
  EXPECT_EQ(again.stream.c_rad, planned.stream.c_rad);
  for (std::size_t i = 0; i < planned.stream.size(); ++i) {
    ASSERT_NEAR(again.truth.clean_mm[i], planned.truth.clean_mm[i], tolerance_mm) << "row " << i;
    ASSERT_NEAR(again.stream.reading_mm[i], planned.stream.reading_mm[i], tolerance_mm);
  }
}

constexpr double rounding_mm = 1e-11;  // of 40 mm, and of times that are added up

TEST(SimulateAt, IdealPartAndNoise) { expect_the_plans_readings(two_set_ups(), rounding_mm); }

TEST(SimulateAt, InstantsThatAreNotEven) {
  Scenario scenario = two_set_ups();
  for (PlannedPass& pass : scenario.plan.passes) pass.jitter = 0.4;
  scenario.effects = {{"part.roundness", {{"order", 3}, {"amplitude_mm", 0.01}}},
                      {"environment.vibration", {{"frequency_hz", 7.3}, {"amplitude_mm", 0.01}}},
                      {"thermal.drift", {{"rate_mm_per_s", 1e-4}, {"amplitude_mm", 0.0}}}};
  expect_the_plans_readings(scenario, rounding_mm);
}

TEST(SimulateAt, SpeedAndFeedAreThoseOfThePasses) {
  Scenario scenario = two_set_ups();
  scenario.effects = {{"probe.latency", {{"delay_s", 1e-3}}},
                      {"probe.lag", {{"time_constant_s", 2e-3}}},
                      {"slide.backlash", {{"along_mm", 0.005}, {"across_mm", 0.003}}}};
  // The feed is a slope by least squares; what rounding leaves of it is far below 1 nm/s.
  expect_the_plans_readings(scenario, 1e-10);
}

TEST(SimulateAt, AGaugesZeroIsFoundFromTheReadingsThatCount) {
  Scenario scenario = two_set_ups();
  scenario.noise = Noise{};
  scenario.probe.relative_zero_mm = 39.3;
  scenario.probe.nominal_radius_mm = 40.0;
  ProbeStream measured = simulate(scenario);
  const ProbeStream clean = measured;
  std::vector<bool> masked(measured.size(), false);
  masked[5] = true;
  measured.reading_mm[5] += 3.0;
  Scenario again = scenario;
  again.probe.relative_zero_mm = 0.0;
  const std::vector<double> readings = resimulate(again, measured, masked);
  EXPECT_NEAR(*again.probe.relative_zero_mm, 39.3, rounding_mm);
  for (std::size_t i = 0; i < readings.size(); ++i)
    ASSERT_NEAR(readings[i], clean.reading_mm[i], rounding_mm);
}

TEST(SimulateAt, AFaceIsNoLateralSurface) {
  const ProbeStream lateral = simulate(two_set_ups());
  Scenario face = two_set_ups();
  face.part.kind = PartKind::face;
  EXPECT_THROW(simulate_at(face, lateral), InputError);
  Scenario endless = two_set_ups();
  endless.u_end_mm.reset();
  EXPECT_THROW(simulate_at(endless, lateral), ContractViolation);
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
