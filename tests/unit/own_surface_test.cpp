// SPDX-License-Identifier: Apache-2.0
// A profile of one's own that is a cone finds what the catalogue's cone finds. Both minimise the
// same sum, so they differ by where the iteration ends only: a thousandth of u is far above that.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/conical_profile.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

ProbeStream tilted_cone() {
  virtual_lathe::Scenario scenario;
  scenario.part.kind = virtual_lathe::PartKind::cone;
  scenario.part.half_angle_rad = 0.2, scenario.part.radius_mm = 40.0;
  scenario.part.x0_mm = 0.16, scenario.part.y0_mm = -0.12;
  scenario.part.l = 8e-4, scenario.part.m = 6e-4;
  virtual_lathe::PlannedPass pass;
  pass.end_mm = 60.0, pass.feed_mm_per_rev = 2.0, pass.readings_per_revolution = 23.7;
  scenario.plan.passes = {pass};
  scenario.noise.sigma_mm = 0.002;
  return virtual_lathe::simulate(scenario);
}

TEST(OwnSurface, AConeIsTheCataloguesCone) {
  const ProbeStream stream = tilted_cone();
  for (const Loss loss : {Loss::plain, Loss::tukey}) {
    FitOptions options;
    options.loss = loss;
    options.influences = {{Influence::Kind::probe_height, 0.01}, {Influence::Kind::c_offset, 1e-3}};
    const FitResult cone = fit(stream, options);
    options.profile = std::make_shared<ConicalProfile>();
    const FitResult own = fit(stream, options);
    ASSERT_EQ(own.status, FitStatus::converged) << own.message;
    EXPECT_EQ(own.surface, SurfaceKind::own);
    for (const char* name : {"x0", "y0", "l", "m"}) {
      const Estimate &a = cone.parameter(name), &b = own.parameter(name);
      EXPECT_NEAR(a.value, b.value, 1e-3 * a.u) << name;
      EXPECT_NEAR(a.u, b.u, 1e-4 * a.u) << name;
    }
    const Estimate& taper = own.parameter("taper");
    EXPECT_NEAR(std::atan(taper.value), cone.parameter("half_angle").value, 1e-3 * taper.u);
    EXPECT_NEAR(own.parameter("radius_at_0").value / taper.value, -cone.parameter("k").value,
                1e-3 * cone.parameter("k").u);
  }
}

TEST(OwnSurface, ReadingsThatItDoesNotKnowAreRefused) {
  ProbeStream stream = tilted_cone();
  FitOptions options;
  options.profile = std::make_shared<ConicalProfile>();
  EXPECT_NO_THROW(fit(stream, options));
  options.ball_radius_mm = 0.5;
  EXPECT_THROW(fit(stream, options), InputError);
  options.ball_radius_mm = 0.0;
  stream.ball_radius_mm = 0.5;
  EXPECT_THROW(fit(stream, options), InputError);
}

}  // namespace
}  // namespace trueaxis::testing
