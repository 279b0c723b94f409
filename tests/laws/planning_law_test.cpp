// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "trueaxis/base/error.hpp"
#include "trueaxis/study/planning.hpp"
#include "trueaxis/study/scenario_parameters.hpp"

namespace trueaxis::testing {
namespace {

using namespace study;

constexpr std::uint64_t seed = 20261121;

/// A cylinder on the axis, one helical pass of whole turns.
PlanningTask cylinder_task() {
  PlanningTask task;
  task.base.part.radius_mm = 40.0;
  task.base.noise.sigma_mm = 3e-3;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 40.0;
  pass.feed_mm_per_rev = 0.5;
  pass.readings_per_revolution = 12.3;
  task.base.plan.passes = {pass};
  task.goal_mm = 0.5e-3;
  task.repeats = 400;
  task.seed = seed;
  task.threads = 1;
  return task;
}

// x(z) = mean + slope × (z − middle) by N readings of x cos C + y sin C: at an end the variance is
// (2σ²/N)(1 + (L/2)²/(L²/12)) = 8σ²/N. What is left: correlation of sin C and Z over 80 turns,
// 1/80.
TEST(PlanningLaw, UncertaintyOfACylinderIsThatOfALine) {
  const PlanningTask task = cylinder_task();
  const PlannedMeasurement plan = planned(task.base, 2.0);
  const double n = static_cast<double>(plan.readings);
  EXPECT_NEAR(plan.readings, 80 * 12.3 + 1, 1.0);
  EXPECT_NEAR(plan.u_expanded_mm, 2.0 * 3e-3 * std::sqrt(8.0 / n), plan.u_expanded_mm / 80.0);
  EXPECT_NEAR(plan.time_s, 80.0 + 1.0, 1e-9);  // 60/min and the pause
  EXPECT_NEAR(plan.rate_hz, 12.3, 1e-12);
}

TEST(PlanningLaw, UncertaintyGoesWithNoiseAndOneOverTheRootOfReadings) {
  PlanningTask task = cylinder_task();
  const PlannedMeasurement once = planned(task.base, 2.0);
  task.base.noise.sigma_mm *= 2.0;
  EXPECT_NEAR(planned(task.base, 2.0).u_expanded_mm, 2.0 * once.u_expanded_mm,
              1e-9 * once.u_expanded_mm);
  task.base.plan.passes[0].readings_per_revolution *= 4.0;
  const PlannedMeasurement four = planned(task.base, 2.0);
  const double root =
      std::sqrt(static_cast<double>(four.readings) / static_cast<double>(once.readings));
  EXPECT_NEAR(four.u_expanded_mm * root, 2.0 * once.u_expanded_mm, 0.005 * once.u_expanded_mm);
}

// Each choice alone is solved for to the digits that can be set, and no more is asked for than
// needed: a step (a tenth of a reading, the third digit) less misses.
TEST(PlanningLaw, SolvesForTheLeastThatMeetsTheGoal) {
  PlanningTask task = cylinder_task();
  task.free = {{Choice::readings_per_revolution, 4.0, 64.0},
               {Choice::sigma, 1e-4, 1e-2},
               {Choice::feed, 0.1, 2.0},
               {Choice::length, 20.0, 200.0}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_EQ(answer.alone.size(), task.free.size());
  for (const Alone& one : answer.alone) {
    SCOPED_TRACE(path_of(one.choice));
    ASSERT_TRUE(one.reached);
    EXPECT_LE(one.plan.u_expanded_mm, task.goal_mm * (1.0 + 1e-9));
    const double value = one.plan.of(one.choice);
    const bool more = one.choice == Choice::readings_per_revolution || one.choice == Choice::length;
    virtual_lathe::Scenario less = one.plan.scenario;
    set_parameter(less, path_of(one.choice), value * (more ? 0.97 : 1.03));
    EXPECT_GT(planned(less, 2.0).u_expanded_mm, task.goal_mm);
    for (const Choice other : choices) {
      if (other != one.choice) {
        EXPECT_EQ(one.plan.of(other), answer.as_given.of(other));
      }
    }
  }
}

// RMSE²/bound² of n efficient repeats is χ²_n/n: the interval of 1 % over all confirmations must
// hold the bound, and five standard errors, 5/√(2n), the ratio.
TEST(PlanningLaw, SimulationConfirmsWhatIsRecommended) {
  PlanningTask task = cylinder_task();
  task.free = {{Choice::readings_per_revolution, 4.0, 64.0}, {Choice::feed, 0.05, 2.0}};
  const PlanningAnswer answer = plan_measurement(task);
  EXPECT_TRUE(answer.reached);
  ASSERT_GE(answer.recommended.size(), 2U);
  for (const Recommendation& one : answer.recommended) {
    SCOPED_TRACE(one.what + ", seed " + std::to_string(seed));
    EXPECT_EQ(one.confirmed.repeats, task.repeats);
    EXPECT_TRUE(one.confirmed.at_bound);
    EXPECT_NEAR(one.confirmed.u_expanded_mm / one.plan.u_expanded_mm, 1.0,
                5.0 / std::sqrt(2.0 * 400.0));
    EXPECT_LT(one.confirmed.interval_95_mm.low, one.confirmed.u_expanded_mm);
    EXPECT_GT(one.confirmed.interval_95_mm.high, one.confirmed.u_expanded_mm);
  }
}

// A bound takes outliers as recognised; the plain fit does not recognise them, and the simulation
// says so: 2 % of 0.1 mm are 14 µm RMS beside 3.
TEST(PlanningLaw, SimulationDoesNotConfirmWhatTheFitCannotDo) {
  PlanningTask task = cylinder_task();
  task.free = {{Choice::readings_per_revolution, 4.0, 64.0}};
  task.base.noise.outlier_fraction = 0.02, task.base.noise.outlier_size_mm = 0.1;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_FALSE(answer.recommended.empty());
  EXPECT_FALSE(answer.recommended.front().confirmed.at_bound) << "seed " << seed;
}

TEST(PlanningLaw, SaysHowNearAnUnreachableGoalComes) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 1e-5;
  task.free = {{Choice::readings_per_revolution, 4.0, 20.0}, {Choice::length, 20.0, 60.0}};
  const PlanningAnswer answer = plan_measurement(task);
  EXPECT_FALSE(answer.reached);
  EXPECT_TRUE(answer.recommended.empty());
  virtual_lathe::Scenario most = task.base;
  set_parameter(most, path_of(Choice::readings_per_revolution), 20.0);
  set_parameter(most, path_of(Choice::length), 60.0);
  EXPECT_NEAR(answer.nearest.u_expanded_mm, planned(most, 2.0).u_expanded_mm, 1e-12);
}

// No plan drawn from the ranges that meets the goal is quicker; 2 % for the grid of lengths.
TEST(PlanningLaw, NothingThatMeetsTheGoalIsQuicker) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 1e-3;
  task.free = {{Choice::readings_per_revolution, 4.0, 30.0},
               {Choice::feed, 0.1, 4.0},
               {Choice::length, 10.0, 60.0}};
  task.repeats = 100;
  task.time_s = 40.0;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_TRUE(answer.reached);
  const auto quickest = std::ranges::find(answer.recommended, "quickest", &Recommendation::what);
  ASSERT_NE(quickest, answer.recommended.end());
  for (const Recommendation& one : answer.recommended) EXPECT_LE(one.plan.time_s, 40.0 + 1e-6);
  std::mt19937_64 draw(seed);
  int met = 0;
  for (int i = 0; i < 150; ++i) {
    virtual_lathe::Scenario scenario = task.base;
    for (const Freedom& free : task.free) {
      const double share = static_cast<double>(draw() >> 11) * 0x1p-53;
      set_parameter(scenario, path_of(free.choice),
                    free.low * std::pow(free.high / free.low, share));
    }
    const PlannedMeasurement plan = planned(scenario, 2.0);
    if (plan.u_expanded_mm > task.goal_mm) continue;
    ++met;
    EXPECT_GE(plan.time_s, 0.98 * quickest->plan.time_s) << "seed " << seed << ", plan " << i;
  }
  EXPECT_GT(met, 5);
}

// With the length alone to choose, the least length is the quickest: one recommendation, not two.
TEST(PlanningLaw, TheLeastLengthIsTheQuickest) {
  PlanningTask task = cylinder_task();
  task.free = {{Choice::length, 20.0, 200.0}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_EQ(answer.recommended.size(), 1U);
  EXPECT_EQ(answer.recommended.front().plan.of(Choice::length),
            answer.alone.front().plan.of(Choice::length));
}

TEST(PlanningLaw, RefusesWhatHasNoAnswer) {
  PlanningTask face = cylinder_task();
  face.base.part.kind = virtual_lathe::PartKind::face;
  EXPECT_THROW(plan_measurement(face), InputError);
  PlanningTask perfect = cylinder_task();
  perfect.base.noise.sigma_mm = 0.0;
  EXPECT_THROW(plan_measurement(perfect), InputError);
  PlanningTask twice = cylinder_task();
  twice.free = {{Choice::feed, 0.1, 1.0}, {Choice::feed, 0.2, 1.0}};
  EXPECT_THROW(plan_measurement(twice), InputError);
  PlanningTask slow = cylinder_task();
  slow.free = {{Choice::readings_per_revolution, 4.0, 20.0}};
  slow.rate_hz = 2.0;
  EXPECT_THROW(plan_measurement(slow), InputError);
}

}  // namespace
}  // namespace trueaxis::testing
