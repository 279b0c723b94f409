// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "simulate/clean_stream.hpp"
#include "study/bound/quantities.hpp"
#include "study/planning/planning.hpp"
#include "study/planning/planning_search.hpp"
#include "study/sweep/scenario_parameters.hpp"
#include "trueaxis/error.hpp"

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
// (2σ²/N)(1 + (L/2)²/(L²/12)) = 8σ²/N. The rest is the correlation of sin C and Z over 80 turns,
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
  task.variables = {{Choice::readings_per_revolution, 4.0, 64.0},
                    {Choice::sigma, 1e-4, 1e-2},
                    {Choice::feed, 0.1, 2.0},
                    {Choice::length, 20.0, 200.0}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_EQ(answer.alone.size(), task.variables.size());
  for (const Alone& one : answer.alone) {
    SCOPED_TRACE(info_of(one.choice).path);
    ASSERT_TRUE(one.reached);
    EXPECT_LE(one.plan.u_expanded_mm, task.goal_mm * (1.0 + 1e-9));
    const double value = one.plan.of(one.choice);
    const bool more = one.choice == Choice::readings_per_revolution || one.choice == Choice::length;
    virtual_lathe::Scenario less = one.plan.scenario;
    set_parameter(less, info_of(one.choice).path, value * (more ? 0.97 : 1.03));
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
  task.variables = {{Choice::readings_per_revolution, 4.0, 64.0}, {Choice::feed, 0.05, 2.0}};
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
// says so: 2 % of 0.1 mm are 14 µm RMS compared with 3.
TEST(PlanningLaw, SimulationDoesNotConfirmWhatTheFitCannotDo) {
  PlanningTask task = cylinder_task();
  task.variables = {{Choice::readings_per_revolution, 4.0, 64.0}};
  task.base.noise.outlier_fraction = 0.02, task.base.noise.outlier_size_mm = 0.1;
  const PlanningAnswer answer = plan_measurement(task);
  EXPECT_TRUE(answer.recommended.empty());
  ASSERT_FALSE(answer.not_confirmed.empty());
  EXPECT_TRUE(answer.reached);
  EXPECT_FALSE(answer.confirmed) << "seed " << seed;
  for (const Recommendation& one : answer.not_confirmed) {
    EXPECT_FALSE(one.confirmed.at_bound) << one.what << ", seed " << seed;
    EXPECT_TRUE(one.confirmed.misses) << one.what << ", seed " << seed;
  }
}

TEST(PlanningLaw, SaysHowNearAnUnreachableGoalComes) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 1e-5;
  task.variables = {{Choice::readings_per_revolution, 4.0, 20.0}, {Choice::length, 20.0, 60.0}};
  const PlanningAnswer answer = plan_measurement(task);
  EXPECT_FALSE(answer.reached);
  EXPECT_TRUE(answer.recommended.empty());
  virtual_lathe::Scenario most = task.base;
  set_parameter(most, info_of(Choice::readings_per_revolution).path, 20.0);
  set_parameter(most, info_of(Choice::length).path, 60.0);
  EXPECT_NEAR(answer.nearest.u_expanded_mm, planned(most, 2.0).u_expanded_mm, 1e-12);
}

// No plan drawn from the ranges that meets the goal is quicker; 2 % for the grid of lengths.
TEST(PlanningLaw, NothingThatMeetsTheGoalIsQuicker) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 1e-3;
  task.variables = {{Choice::readings_per_revolution, 4.0, 30.0},
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
    for (const DesignVariable& variable : task.variables) {
      const double share = static_cast<double>(draw() >> 11) * 0x1p-53;
      set_parameter(scenario, info_of(variable.choice).path,
                    variable.low * std::pow(variable.high / variable.low, share));
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
  task.variables = {{Choice::length, 20.0, 200.0}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_EQ(answer.recommended.size(), 1U);
  EXPECT_EQ(answer.recommended.front().plan.of(Choice::length),
            answer.alone.front().plan.of(Choice::length));
}

TEST(PlanningLaw, RefusesWhatHasNoAnswer) {
  PlanningTask perfect = cylinder_task();
  perfect.base.noise.sigma_mm = 0.0;
  EXPECT_THROW(plan_measurement(perfect), InputError);
  PlanningTask twice = cylinder_task();
  twice.variables = {{Choice::feed, 0.1, 1.0}, {Choice::feed, 0.2, 1.0}};
  EXPECT_THROW(plan_measurement(twice), InputError);
  PlanningTask slow = cylinder_task();
  slow.variables = {{Choice::readings_per_revolution, 4.0, 20.0}};
  slow.rate_hz = 2.0;
  EXPECT_THROW(plan_measurement(slow), InputError);
  PlanningTask gauge = cylinder_task();
  gauge.base.probe.relative_zero_mm = 0.0;
  EXPECT_THROW(plan_measurement(gauge), InputError);  // nominal radius
  PlanningTask moved = cylinder_task();
  moved.base.plan.passes.push_back(moved.base.plan.passes[0]);
  moved.base.plan.passes[1].setup = 2;
  virtual_lathe::Chucking elsewhere;
  elsewhere.number = 2, elsewhere.x0_mm = 0.1;
  moved.base.plan.setups = {elsewhere};
  EXPECT_THROW(plan_measurement(moved), InputError);
}

TEST(PlanningLaw, PlansWithAGaugeAndAfterClampingAgain) {
  PlanningTask gauge = cylinder_task();
  gauge.base.probe.relative_zero_mm = 20.0;
  gauge.base.probe.nominal_radius_mm = gauge.base.part.radius_mm;
  PlanningTask again = cylinder_task();
  again.base.plan.passes.push_back(again.base.plan.passes[0]);
  again.base.plan.passes[1].setup = 2;
  virtual_lathe::Chucking turned;
  turned.number = 2, turned.reindex_rad = 1.0, turned.x0_mm = 0.1, turned.l = 5e-4;
  again.base.plan.setups = {turned};
  // Of a cylinder the axis is all but uncorrelated with radius and zero, and each clamping's is
  // known from its own readings: what is known of it is as with one pass of an absolute probe.
  const double plain = plan_measurement(cylinder_task()).as_given.u_expanded_mm;
  for (PlanningTask* task : {&gauge, &again}) {
    task->variables = {{Choice::readings_per_revolution, 4.0, 500.0}};
    task->goal_mm = 0.7 * plain;
    const PlanningAnswer answer = plan_measurement(*task);
    EXPECT_NEAR(answer.as_given.u_expanded_mm, plain, 0.01 * plain);
    ASSERT_FALSE(answer.recommended.empty());
    EXPECT_TRUE(answer.recommended.front().confirmed.at_bound);
    EXPECT_EQ(answer.recommended.front().confirmed.failures, 0U);
  }
}

// Every k-th of many independent readings has 1/k of the information: compared with the bound of
// all, that is off for two reasons. One is the readings at the ends of the pass, some of N' = 20
// 000. The other is those at the ends of the turn in which a cut falls, 1/turns of the correlation
// of a turn and Z. In both 1e-3 is wide.
TEST(PlanningLaw, LongStreamsAreAsCertainAsAllTheirReadings) {
  for (const bool cone : {false, true}) {
    PlanningTask task = cylinder_task();
    if (cone) {
      task.base.part.kind = virtual_lathe::PartKind::cone;
      task.base.part.half_angle_rad = 0.2;
      task.base.part.x0_mm = 0.05;
    }
    task.base.plan.passes.push_back(task.base.plan.passes[0]);
    task.base.plan.passes[1].readings_per_revolution = 1200.7;
    task.base.plan.passes[1].end_mm = 30.0;
    task.base.plan.passes[0].readings_per_revolution = 400.0;
    const virtual_lathe::Scenario& scenario = task.base;
    const PlannedMeasurement plan = planned(scenario, 2.0);
    ASSERT_EQ(plan.readings, virtual_lathe::simulate_clean(scenario).value_mm.size());
    ASSERT_GT(plan.readings, 5U * 20'000U);
    const double exact =
        2.0 * planning_detail::worst_of_axis(
                  scenario, bound_of(scenario, study::surface_of(scenario.part.kind)))
                  .sd_mm;
    EXPECT_NEAR(plan.u_expanded_mm, exact, 1e-3 * exact) << "cone " << cone;
  }
}

// Readings that follow each other closely repeat each other's noise: nothing is scaled.
TEST(PlanningLaw, CorrelatedNoiseIsNotThinned) {
  PlanningTask task = cylinder_task();
  task.base.plan.passes[0].readings_per_revolution = 300.3;
  ASSERT_GT(planning_detail::stand_in(task.base).readings_each, 1.1);
  task.base.noise.rho = 0.9;
  EXPECT_EQ(planning_detail::stand_in(task.base).readings_each, 1.0);
}

// The height d − l x − m y at the rim, by N readings at radii X over turns: d has a variance of
// σ²/N, and l and m each 2σ²/(N mean X²). The rest is the correlation of cos C and X within the
// turns that differ in X: less than 1/(2π turns) of it, 1 % of 16.
TEST(PlanningLaw, AFaceIsPlannedForItsHeightAtTheRim) {
  PlanningTask task = cylinder_task();
  task.base.part.kind = virtual_lathe::PartKind::face;
  virtual_lathe::PlannedPass& pass = task.base.plan.passes[0];
  pass.start_mm = 20.0, pass.end_mm = 36.0, pass.feed_mm_per_rev = 1.0;
  task.variables = {{Choice::readings_per_revolution, 4.0, 500.0}};
  const PlannedMeasurement as_given = planned(task.base, 2.0);
  const double square = (20.0 * 20.0 + 20.0 * 36.0 + 36.0 * 36.0) / 3.0;
  const double expected =
      2.0 * 3e-3 *
      std::sqrt((1.0 + 2.0 * 36.0 * 36.0 / square) / static_cast<double>(as_given.readings));
  EXPECT_NEAR(as_given.u_expanded_mm, expected, 0.01 * expected);
  task.goal_mm = 0.5 * expected;
  const PlanningAnswer answer = plan_measurement(task);
  ASSERT_FALSE(answer.recommended.empty());
  const Recommendation& one = answer.recommended.front();
  EXPECT_NEAR(one.plan.of(Choice::readings_per_revolution), 4.0 * 12.3, 0.05 * 4.0 * 12.3);
  EXPECT_TRUE(one.confirmed.at_bound);
  EXPECT_EQ(one.confirmed.failures, 0U);
}

// At two readings per revolution sin C is 0 at every one: one direction is never looked at.
TEST(PlanningLaw, HalfTurnsDetermineNoAxis) {
  PlanningTask task = cylinder_task();
  task.base.plan.passes[0].readings_per_revolution = 2.0;
  EXPECT_FALSE(std::isfinite(planned(task.base, 2.0).u_expanded_mm));
}

// What is recommended or in the table can be set as printed: length, feed and noise have
// three digits, readings per revolution a tenth.
TEST(PlanningLaw, EveryPlanCanBeSet) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 0.3e-3;
  task.time_s = 60.0;
  task.variables = {{Choice::readings_per_revolution, 4.0, 60.0},
                    {Choice::sigma, 5e-4, 3e-3},
                    {Choice::feed, 0.1, 2.0},
                    {Choice::length, 20.0, 100.0}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  std::vector<const PlannedMeasurement*> plans{&answer.nearest};
  for (const Recommendation& one : answer.recommended) plans.push_back(&one.plan);
  for (const TableRow& row : answer.table) plans.push_back(&row.plan);
  ASSERT_GT(plans.size(), 28U);
  for (const PlannedMeasurement* plan : plans) {
    for (const Choice choice : choices) {
      const double value = plan->of(choice);
      const double step = choice == Choice::readings_per_revolution
                              ? 0.1
                              : std::pow(10.0, std::floor(std::log10(value * (1 + 1e-12))) - 2.0);
      EXPECT_NEAR(value / step, std::round(value / step), 1e-6)
          << info_of(choice).path << ' ' << value;
    }
  }
}

TEST(PlanningLaw, AsksForNoBetterProbeThanTheOneThatDoes) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 2e-3;  // as given 2 × 3 √(8/985) = 0.54 µm
  task.variables = {{Choice::sigma, 1e-4, 1e-3}};
  task.repeats = 100;
  const PlanningAnswer answer = plan_measurement(task);
  EXPECT_TRUE(answer.reached);
  for (const Recommendation& one : answer.recommended)
    EXPECT_EQ(one.plan.of(Choice::sigma), 3e-3) << one.what;
}

// 10 readings a second cannot give 12.3 readings per revolution at one revolution a second.
TEST(PlanningLaw, RecommendsNothingThatTheProbeCannotFollow) {
  PlanningTask task = cylinder_task();
  task.goal_mm = 2e-3;
  task.rate_hz = 10.0;
  task.repeats = 100;
  task.variables = {{Choice::length, 20.0, 60.0}};
  const PlanningAnswer stuck = plan_measurement(task);
  EXPECT_FALSE(stuck.reached);
  EXPECT_TRUE(stuck.recommended.empty());
  task.variables.push_back({Choice::readings_per_revolution, 4.0, 60.0});
  const PlanningAnswer slower = plan_measurement(task);
  EXPECT_TRUE(slower.reached);
  ASSERT_FALSE(slower.recommended.empty());
  for (const Recommendation& one : slower.recommended) EXPECT_LE(one.plan.rate_hz, 10.0);
}

TEST(PlanningLaw, TellsEveryStepOneAtATime) {
  PlanningTask task = cylinder_task();
  task.variables = {{Choice::readings_per_revolution, 4.0, 64.0}, {Choice::length, 20.0, 60.0}};
  task.threads = 3;
  std::size_t last = 0, of_simulation = 0;
  PlanningStage at = PlanningStage::search;
  const PlanningAnswer answer =
      plan_measurement(task, [&](PlanningStage stage, std::size_t done, std::size_t to_do) {
        if (stage != at) {
          EXPECT_EQ(stage, PlanningStage::simulation);
          at = stage, last = 0;
        }
        EXPECT_GT(done, last);
        EXPECT_LE(done, to_do);
        last = done;
        if (stage == PlanningStage::simulation) of_simulation = to_do;
      });
  EXPECT_EQ(at, PlanningStage::simulation);
  EXPECT_EQ(last, of_simulation);
  EXPECT_EQ(of_simulation, answer.recommended.size() * task.repeats);
}

}  // namespace
}  // namespace trueaxis::testing
