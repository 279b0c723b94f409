// SPDX-License-Identifier: Apache-2.0
// Where an axis is when its part was probed: after slips, and the line nearest to a bow.
#include "simulate/axis_at_end.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::virtual_lathe {
namespace {

Scenario cylinder() {
  Scenario scenario;
  scenario.part.kind = PartKind::cylinder;
  scenario.part.radius_mm = 30.0;
  scenario.part.x0_mm = 0.1, scenario.part.y0_mm = -0.05;
  scenario.part.l = 3e-4, scenario.part.m = -2e-4;
  scenario.plan.passes.resize(1);
  PlannedPass& pass = scenario.plan.passes[0];
  pass.start_mm = 5.0, pass.end_mm = 45.0;
  pass.feed_mm_per_rev = 1.0, pass.readings_per_revolution = 36.7, pass.speed_rpm = 60.0;
  return scenario;
}

TEST(AxisAtEnd, IsNoneWhereNothingMovesOrBends) {
  Scenario scenario = cylinder();
  scenario.effects = {{"part.roundness", {{"order", 2}, {"amplitude_mm", 0.01}}}};
  EXPECT_FALSE(axis_at_end(scenario, {}, 5.0, 45.0, 40.0));
}

// κ (s − v)² from a to b has the mean κ ((b − v)³ − (a − v)³)/(3 (b − a)) and the nearest line's
// slope κ (a + b − 2 v): at 1e-6 of the sagitta by its sections.
TEST(AxisAtEnd, OfABowIsTheNearestLine) {
  Scenario scenario = cylinder();
  scenario.part.l = scenario.part.m = 0.0;
  for (const double vertex : {25.0, 5.0, 60.0}) {
    scenario.effects = {
        {"part.bow", {{"sagitta_mm", 0.02}, {"length_mm", 40.0}, {"middle_mm", vertex}}}};
    const auto axis = axis_at_end(scenario, {}, 5.0, 45.0, 40.0);
    ASSERT_TRUE(axis);
    const double kappa = 0.02 / (20.0 * 20.0), a = 5.0 - vertex, b = 45.0 - vertex;
    const double slope = kappa * (a + b), mean = kappa * (b * b * b - a * a * a) / 120.0;
    EXPECT_NEAR(axis->l, slope / std::hypot(1.0, slope), 1e-9) << vertex;
    EXPECT_NEAR(axis->x0_mm, 0.1 + mean - slope * 25.0, 1e-6 * 0.02 * 40.0) << vertex;
    EXPECT_NEAR(axis->y0_mm, -0.05, 1e-13) << vertex;
  }
}

// A part that slipped before the first reading is probed where it is: the fit of the lathe's
// readings, to the rounding of its numbers.
TEST(AxisAtEnd, AfterASlipIsWhereThePartIsProbed) {
  Scenario scenario = cylinder();
  scenario.effects = {{"part.slip",
                       {{"time_s", -1.0},
                        {"dx_mm", 0.04},
                        {"dy_mm", 0.01},
                        {"turn_rad", 0.02},
                        {"tilt_x_rad", 2e-4},
                        {"tilt_y_rad", -1e-4},
                        {"middle_mm", 20.0}}}};
  const auto axis = axis_at_end(scenario, {}, 5.0, 45.0, 40.0);
  ASSERT_TRUE(axis);
  FitOptions options;
  options.surface = SurfaceKind::cylinder;
  const FitResult fitted = fit(simulate(scenario), options);
  EXPECT_NEAR(axis->x0_mm, fitted.axis.axis.at(0.0)[0], 1e-9);
  EXPECT_NEAR(axis->y0_mm, fitted.axis.axis.at(0.0)[1], 1e-9);
  EXPECT_NEAR(axis->l, fitted.parameters[2].estimate.value, 1e-11);
  EXPECT_NEAR(axis->m, fitted.parameters[3].estimate.value, 1e-11);
}

}  // namespace
}  // namespace trueaxis::virtual_lathe
