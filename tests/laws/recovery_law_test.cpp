// SPDX-License-Identifier: Apache-2.0
// Law: from noise-free readings of the virtual lathe the fit finds the part, without a guess and to
// rounding × condition.
#include <gtest/gtest.h>

#include <cmath>

#include "laws/law_case.hpp"

namespace trueaxis::laws {
namespace {

void expect_recovered(const LawCase& c, const char* hint = "") {
  SCOPED_TRACE(::testing::Message() << hint << ' ' << to_literal(c));
  const FitResult result = fit(probe(c), options_of(c));
  ASSERT_EQ(result.status, FitStatus::converged) << result.message;
  const std::vector<double> expected = expected_parameters(c);
  const std::vector<double> tolerance = rounding_of_parameters(c, result);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const FitParameter& parameter = result.parameters[i];
    if (c.relative && (parameter.name == "radius" || parameter.name == "k")) {
      EXPECT_TRUE(std::isnan(parameter.estimate.value)) << parameter.name;
      EXPECT_NE(parameter.estimate.why_not.find("gauge"), std::string::npos) << parameter.name;
      continue;
    }
    EXPECT_NEAR(parameter.estimate.value, expected[i], tolerance[i]) << parameter.name;
  }
}

class RecoveryLaw : public ::testing::TestWithParam<std::string> {};
class GaugeLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(RecoveryLaw, AnywhereInTheStatedDomain) {
  constexpr std::uint64_t seed = 20261;
  Draw draw(seed);
  for (int i = 0; i < 500; ++i) expect_recovered(draw_case(GetParam(), draw), "seed 20261");
}

TEST_P(RecoveryLaw, LittleMoreThanATurnOfAShortPart) {
  // Where a mirrored tilt is a second minimum.
  constexpr std::uint64_t seed = 20262;
  Draw draw(seed);
  for (int i = 0; i < 300; ++i) {
    LawCase c = draw_case(GetParam(), draw, {.length_max_mm = 5.0, .readings_max = 300.0});
    c.readings_per_revolution *= c.revolutions / 1.1, c.revolutions = 1.1;
    expect_recovered(c, "seed 20262");
  }
}

TEST_P(GaugeLaw, RelativeGauge) {
  constexpr std::uint64_t seed = 20263;
  Draw draw(seed);
  for (int i = 0; i < 300; ++i) {
    LawCase c = draw_case(GetParam(), draw, {});
    c.relative = true, c.rear = i % 2 == 1;
    expect_recovered(c, "seed 20263");
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, RecoveryLaw, ::testing::ValuesIn(catalogue_ids()), name_of);
INSTANTIATE_TEST_SUITE_P(Lateral, GaugeLaw, ::testing::ValuesIn(lateral_ids()), name_of);

TEST(Recovery, ConesOfEveryAngleThatOpenEitherWay) {
  for (const double angle : {0.05, 0.5, 3.0, 15.0, 45.0, 70.0, 80.0}) {
    for (const double sign : {1.0, -1.0}) {
      for (const bool rear : {false, true}) {
        LawCase c;
        c.half_angle_deg = sign * angle;
        c.end_mm = 8.0, c.radius_mm = 30.0;
        c.x_mm = 4.0, c.y_mm = -2.5, c.slope_x = 0.01, c.slope_y = 0.02;
        c.rear = rear;
        expect_recovered(c);
      }
    }
  }
}

TEST(Recovery, EccentricityUpToTheRadius) {
  EXPECT_GE(catalogue_ids().size(), 4u);  // cone, cylinder and section, without the plane
  for (const std::string& id : catalogue_ids()) {
    if (id == "plane") continue;
    for (const double share : {0.9, 0.95, 0.99, 0.999, 0.9999}) {
      LawCase c;
      c.surface = id;
      c.half_angle_deg = id == "cone" ? 0.5 : 0.0;
      c.radius_mm = 20.1, c.end_mm = 10.0;  // the cone's small end has more than 20
      c.x_mm = -0.6 * share * 20.0, c.y_mm = 0.8 * share * 20.0;
      expect_recovered(c);
    }
  }
}

// A plane shows a direction and no place: its axis is the normal through the spindle axis at Z 0.
TEST(Recovery, ThePlanesAxisIsItsNormalThroughTheSpindleAxis) {
  constexpr std::uint64_t seed = 20264;
  Draw draw(seed);
  for (int i = 0; i < 50; ++i) {
    const LawCase c = draw_case("plane", draw);
    SCOPED_TRACE(::testing::Message() << "seed 20264 " << to_literal(c));
    const FitResult result = fit(probe(c), options_of(c));
    const std::vector<double> tolerance = rounding_of_parameters(c, result);
    for (const double z_mm : {-100.0, 0.0, 100.0}) {
      const auto [x_mm, y_mm] = result.axis.axis.at(z_mm);
      // A slope l/n, n² = 1 − l² − m², changes by at most 1/n³ of l, which is 2.8 at 45°.
      EXPECT_NEAR(x_mm, c.slope_x * z_mm, 3.0 * tolerance[0] * std::abs(z_mm));
      EXPECT_NEAR(y_mm, c.slope_y * z_mm, 3.0 * tolerance[1] * std::abs(z_mm));
    }
  }
}

TEST(Recovery, TwoAndAThirdReadingsARevolutionAndThreeHundredAndSixty) {
  for (const double per_revolution : {2.3, 2.0 + 1e-3, 3.0 + 1e-2, 360.0}) {
    LawCase c;
    c.half_angle_deg = 5.0, c.x_mm = 3.0, c.slope_y = 0.002;
    c.readings_per_revolution = per_revolution, c.revolutions = 50.0;
    expect_recovered(c);
  }
}

}  // namespace
}  // namespace trueaxis::laws
