// SPDX-License-Identifier: Apache-2.0
// Law: the values of ISO 230-7 of motions whose values are known in closed form, and the angles
// that are proposed.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "laws/spindle_bench.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::laws {
namespace {

constexpr double nm = 1e-6;

virtual_lathe::Effect motion(const char* id, double order, double amplitude_mm) {
  return {id, {{"order", order}, {"amplitude_mm", amplitude_mm}}};
}

TEST(SpindleValuesLaw, SynchronousAsynchronousAndTotalOfTwoCosines) {
  SpindleBench bench(1);
  bench.sensors_deg({0, 55, 113.2});
  bench.passes({1}, 20.0, 360.0);
  constexpr double a = 1e-3, b = 4e-4;
  bench.scenario.effects = {motion("spindle.radial_synchronous", 2.0, a),
                            motion("spindle.asynchronous", 2.4, b),
                            motion("extra.radial_motion_y", 3.0, 2.0 * a)};
  const SpindleResult result = bench.separate();
  const ErrorMotion& radial = *result.radial;
  EXPECT_NEAR(radial.sensitive.synchronous.value, 2.0 * a, 5.0 * nm);
  EXPECT_NEAR(radial.across.synchronous.value, 4.0 * a, 5.0 * nm);
  // Order 2.4 passes every angle at five phases 72° apart: the widest band is 2 b cos 18°. The last
  // reading meets the first angle a 21st time, so that its mean over the turns keeps b / 21.
  EXPECT_NEAR(radial.sensitive.asynchronous.value, 2.0 * b * std::cos(std::numbers::pi / 10.0),
              b / 21.0);
  EXPECT_LT(radial.across.asynchronous.value, 0.01 * b);
  EXPECT_LE(radial.sensitive.total.value, 2.0 * (a + b) + 5.0 * nm);
  EXPECT_GE(radial.sensitive.total.value, 2.0 * (a + b) * std::cos(0.3));
  ASSERT_TRUE(radial.form.interval) << "no form";
  EXPECT_LT(radial.form.interval->back(), 5.0 * nm);
  EXPECT_NEAR(radial.runs.front().eccentricity.value, std::hypot(0.006, 0.004), 5.0 * nm);
  EXPECT_NEAR(radial.runs.front().eccentricity_angle_rad, std::atan2(-0.004, 0.006), 1e-3);
  EXPECT_NEAR(radial.runs.front().turns, 20.0, 0.01);
}

// Half a line off order 2 and less, a motion reads like the order in the time of 20 turns, and had
// moved it by five U. What the lines next to the order hold of it tells how much.
TEST(SpindleValuesLaw, AMotionCloseToAnOrderIsNotTakenForIt) {
  constexpr double a = 3e-4;
  int held = 0, all = 0;
  for (const double order : {1.96, 1.985, 2.03})
    for (const int seed : {1, 2, 3}) {
      SpindleBench bench(1);
      bench.sensors_deg({0, 55, 113.2});
      bench.passes({1}, 20.0, 256.0);
      virtual_lathe::Effect near = motion("spindle.asynchronous", order, 0.5 * a);
      near.parameters["phase_rad"] = 2.0 * seed;
      bench.scenario.seed = static_cast<std::uint64_t>(seed);
      bench.scenario.noise.sigma_mm = 100.0 * nm;
      bench.scenario.effects = {motion("spindle.radial_synchronous", 2.0, a), near};
      const SpindleResult result = bench.separate();
      const Estimate& value = result.radial->sensitive.synchronous;
      held += holds(value, 2.0 * a) ? 1 : 0;
      EXPECT_LT(value.u, 0.2 * a) << order;
      ++all;
    }
  EXPECT_GE(held, all - 2);  // binomial of 95 %: fewer in 1 of 100
}

/// A face probed along Z at one X.
virtual_lathe::Scenario face_scenario(double x_mm) {
  virtual_lathe::Scenario scenario;
  scenario.part.kind = virtual_lathe::PartKind::face;
  scenario.part.d_mm = 50.0;
  scenario.part.l = 2e-4;
  virtual_lathe::PlannedPass pass;
  pass.start_mm = pass.end_mm = x_mm;
  pass.revolutions = 10.0;
  pass.readings_per_revolution = 200.0;
  scenario.plan.passes = {pass};
  return scenario;
}

TEST(SpindleValuesLaw, OnTheAxisTheFundamentalAxialMotionIsTwiceItsAmplitude) {
  virtual_lathe::Scenario scenario = face_scenario(0.0);
  constexpr double a = 8e-4, b = 3e-4;
  scenario.effects = {motion("spindle.axial_synchronous", 1.0, a),
                      motion("spindle.axial_synchronous", 3.0, b)};
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  const SpindleResult result = separate_spindle({&stream, 1}, exact_angles());
  ASSERT_TRUE(result.axial.has_value());
  EXPECT_FALSE(result.radial.has_value());
  EXPECT_NEAR(result.axial->fundamental.value, 2.0 * a, 1.0 * nm);
  EXPECT_NEAR(result.axial->residual.value, 2.0 * b, 2.0 * nm);
  EXPECT_FALSE(result.axial->form.determined());
}

TEST(SpindleValuesLaw, OffTheAxisReIndexingTellsAxialMotionFromTheFace) {
  virtual_lathe::Scenario scenario = face_scenario(30.0);
  constexpr double a = 8e-4, b = 3e-4;
  scenario.effects = {motion("spindle.axial_synchronous", 3.0, a),
                      motion("part.roundness", 4.0, b)};
  const virtual_lathe::PlannedPass pass = scenario.plan.passes.front();
  scenario.plan.passes.clear();
  for (int number = 1; number <= 3; ++number) {
    virtual_lathe::Chucking setup;
    setup.number = number;
    setup.reindex_rad = (number - 1) * 110.0 * rad_per_deg;
    scenario.plan.setups.push_back(setup);
    scenario.plan.passes.push_back(pass);
    scenario.plan.passes.back().setup = number;
  }
  const ProbeStream stream = virtual_lathe::simulate(scenario);
  const SpindleResult result = separate_spindle({&stream, 1}, exact_angles());
  EXPECT_NEAR(result.axial->sensitive.synchronous.value, 2.0 * a, 5.0 * nm);
  EXPECT_NEAR(result.axial->form.value, 2.0 * b, 5.0 * nm);
  EXPECT_FALSE(result.axial->fundamental.determined());
}

TEST(SpindleValuesLaw, TheAsynchronousUncertaintyIsHowMuchRecordingsDiffer) {
  SpindleBench bench(3);
  bench.sensors_deg({0, 55, 113.2});
  bench.passes({1}, 16.0, 100.0);
  bench.scenario.effects.clear();
  bench.scenario.noise.sigma_mm = 1e-4;
  SpindleOptions options = exact_angles();
  options.order_max = 10;
  std::vector<double> value, u;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    bench.scenario.seed = seed;
    const MotionValues values = bench.separate(options).radial->sensitive;
    value.push_back(values.asynchronous.value);
    u.push_back(values.asynchronous.u);
  }
  double mean = 0.0, variance = 0.0, stated = 0.0;
  for (const double one : value) mean += one / 40.0;
  for (const double one : value) variance += (one - mean) * (one - mean) / 39.0;
  for (const double one : u) stated += one * one / 40.0;
  // χ² of 39: the ratio of variances lies in 0.43 … 1.9 in 999 of 1000.
  EXPECT_GT(stated / variance, 0.45);
  EXPECT_LT(stated / variance, 2.4);
}

double worst(std::span<const double> angles_rad) {
  const auto conditions = separation_conditions(angles_rad, 2, 100);
  return *std::ranges::max_element(conditions);
}

TEST(SpindleValuesLaw, NoDrawnAnglesAreBetterThanThoseProposed) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> angle(0.0, two_pi);
  for (const int sensors : {3, 4}) {
    ProposeOptions options;
    options.sensors = sensors;
    const std::vector<double> proposed = propose_sensor_angles(options);
    ASSERT_EQ(proposed.size(), static_cast<std::size_t>(sensors));
    EXPECT_EQ(proposed, propose_sensor_angles(options));
    const double best = worst(proposed);
    for (std::size_t i = 0; i < proposed.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(std::abs(std::remainder(proposed[i] - proposed[j], two_pi)),
                  options.least_apart_rad - 1e-9);
    for (int draw = 0; draw < 400; ++draw) {
      std::vector<double> drawn{0.0};
      while (drawn.size() < proposed.size()) drawn.push_back(angle(engine));
      EXPECT_GE(worst(drawn), best);
    }
  }
}

TEST(SpindleValuesLaw, SensorsThatDoNotFitAreRefused) {
  ProposeOptions options;
  options.sensors = 8;
  options.least_apart_rad = 1.0;
  EXPECT_THROW(propose_sensor_angles(options), InputError);
  options.sensors = 2;
  options.least_apart_rad = 0.1;
  EXPECT_THROW(propose_sensor_angles(options), InputError);
}

}  // namespace
}  // namespace trueaxis::laws
