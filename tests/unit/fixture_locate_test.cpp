// SPDX-License-Identifier: Apache-2.0
// Six contacts and the ten steps of Hong & Yeh, against parts placed by the test's own matrices.
#include <gtest/gtest.h>

#include "support/random_fixture.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

// Rounding: coordinates of 100 mm have 1.4e-14 mm, six equations of condition below 100.
constexpr double rounding = 1e-11;

TEST(FixtureLocate, SixContactsFindThePartAgain) {
  constexpr unsigned seed = 1201;
  FixtureDraw draw(seed);
  for (int i = 0; i < 500; ++i) {
    const Matrix4 D = draw.displacement(3.0, 0.15);
    const DatumErrors datums = draw.datums(0.5, 0.05);
    const PartSetup setup = locate_rigidly(draw.touching(D, datums), datums);
    ASSERT_TRUE(setup.converged) << "seed " << seed << ", case " << i;
    ASSERT_LT(difference(setup.fixture_from_part, D), rounding)
        << "seed " << seed << ", case " << i;
    const Matrix4 again = times(Tr(setup.errors[0], setup.errors[1], setup.errors[2]),
                                exp({setup.errors[3], setup.errors[4], setup.errors[5]}));
    ASSERT_LT(difference(setup.fixture_from_part, again), rounding) << "X0W … C0W";
  }
}

// GUM 5.1.2: u² = Σ (∂/∂m)² u² over all 18 coordinates, the derivatives by central differences of
// 10 µm, which leave out less than 1e-6 of them.
TEST(FixtureLocate, UncertaintyIsThatOfAllCoordinates) {
  constexpr unsigned seed = 1202;
  FixtureDraw draw(seed);
  for (int i = 0; i < 10; ++i) {
    const DatumErrors datums = draw.datums(0.5, 0.05);
    const Locators locators = draw.touching(draw.displacement(3.0, 0.15), datums);
    const PartSetup setup = locate_rigidly(locators, datums);
    for (std::size_t e = 0; e < 6; ++e) {
      double variance = 0.0;
      for (std::size_t l = 0; l < locator_count; ++l) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          Locators low = locators, high = locators;
          low[l].measured_mm[axis] -= 0.01;
          high[l].measured_mm[axis] += 0.01;
          const double slope =
              (locate_rigidly(high, datums).errors[e] - locate_rigidly(low, datums).errors[e]) /
              0.02;
          variance += slope * slope * locators[l].u_mm * locators[l].u_mm;
        }
      }
      EXPECT_NEAR(setup.u(e) / std::sqrt(variance), 1.0, 1e-5) << "seed " << seed << ", " << i;
    }
  }
}

TEST(FixtureLocate, WithoutStatedUncertaintyThereIsNone) {
  FixtureDraw draw(1203);
  Locators locators = draw.touching(unit_matrix(), {});
  locators[4].u_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(locate_rigidly(locators).u(0)));
}

/// Readings of the frame of Hong & Yeh: m = Rx(α) Ry(β) Rz(γ) (p + d), locators of one plane level.
Locators readings_of(const Vector3& angles_deg, const Vector3& d_mm) {
  const Matrix4 R = times(Rx(angles_deg[0] * rad_per_deg), Ry(angles_deg[1] * rad_per_deg),
                          Rz(angles_deg[2] * rad_per_deg));
  const Vector3 places[] = {{15, 12, 3},  {105, 12, 3},  {60, 68, 3},
                            {20, -2, 12}, {100, -2, 12}, {1, 40, 12}};
  Locators locators;
  for (std::size_t i = 0; i < locator_count; ++i) {
    locators[i].ideal_mm = places[i];
    Vector3 p = places[i];
    for (std::size_t k = 0; k < 3; ++k) p[k] += d_mm[k];
    locators[i].measured_mm = turned(R, p);
  }
  return locators;
}

TEST(FixtureLocate, TheTenStepsGiveTableOne) {
  const Vector3 angles_deg{0.1066, -0.0217, -0.0065}, d_mm{-0.1819, 0.1141, -0.0663};
  const Locators locators = readings_of(angles_deg, d_mm);
  const PrintedLocation printed = locate_as_printed(locators);
  // Rounding of 1e-14 mm over 50 mm, in degrees 1e-14; arcus cosine near 90° keeps it.
  EXPECT_NEAR(printed.alpha_rad / rad_per_deg, angles_deg[0], 1e-11);
  EXPECT_NEAR(printed.beta_rad / rad_per_deg, angles_deg[1], 1e-11);
  EXPECT_NEAR(printed.gamma_rad / rad_per_deg, angles_deg[2], 1e-11);
  EXPECT_NEAR(printed.gamma_as_printed_rad / rad_per_deg, 180.0 + angles_deg[2], 1e-11);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(printed.d_mm[k], d_mm[k], 1e-12);
  // d in frame 0 is the rigid shift, to the digits that are known of it.
  const PartSetup rigid = locate_rigidly(locators);
  const double shift_mm[] = {-0.181862, 0.114244, -0.066156};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(rigid.errors[k], shift_mm[k], 5e-7);
  EXPECT_LT(difference(rigid.fixture_from_part,
                       times(Tr(rigid.errors[0], rigid.errors[1], rigid.errors[2]),
                             Rx(angles_deg[0] * rad_per_deg), Ry(angles_deg[1] * rad_per_deg),
                             Rz(angles_deg[2] * rad_per_deg))),
            rounding);
}

TEST(FixtureLocate, GammaIsPrintedRightWhereItIsPositiveAndNotDefinedWhereLevel) {
  const PrintedLocation positive = locate_as_printed(readings_of({-0.3, 0.2, 1.7}, {1, 2, 3}));
  EXPECT_NEAR(positive.gamma_rad / rad_per_deg, 1.7, 1e-11);
  EXPECT_NEAR(positive.gamma_as_printed_rad, positive.gamma_rad, 1e-13);
  const PrintedLocation level = locate_as_printed(readings_of({0, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(level.gamma_rad, 0.0);
  EXPECT_TRUE(std::isnan(level.gamma_as_printed_rad));
}

// Of locators that are level and a perfect part both are the same rotation, and the rigid shift is
// d in frame 0; whatever the angles, side locators of other lengths too.
TEST(FixtureLocate, BothAgreeWhereThePaperIsRight) {
  constexpr unsigned seed = 1204;
  FixtureDraw draw(seed);
  for (int i = 0; i < 200; ++i) {
    const Vector3 angles_deg = draw.vector(9.0), d_mm = draw.vector(2.0);
    Locators locators = readings_of(angles_deg, d_mm);
    const double longer_mm = draw.within(-5, 5);  // E, along Y of frame 2
    const Matrix4 R = times(Rx(angles_deg[0] * rad_per_deg), Ry(angles_deg[1] * rad_per_deg),
                            Rz(angles_deg[2] * rad_per_deg));
    locators[4].ideal_mm[1] += longer_mm;
    for (std::size_t k = 0; k < 3; ++k) locators[4].measured_mm[k] += longer_mm * R[k][1];
    const PrintedLocation printed = locate_as_printed(locators);
    const PartSetup rigid = locate_rigidly(locators);
    const Matrix4 expected = times(R, Tr(d_mm));
    ASSERT_LT(difference(rigid.fixture_from_part, expected), rounding) << "seed " << seed;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(printed.d_mm[k], d_mm[k], rounding) << "seed " << seed << ", case " << i;
      for (std::size_t j = 0; j < 3; ++j)
        ASSERT_NEAR(printed.fixture_from_part_as_printed.rotation[k][j], R[k][j], rounding);
    }
  }
}

// (4.3) takes the ideal lengths off along Z of frame 0, where the part has them along its own z. A
// part is tilted by α about X on locators at y = 0 and y = b, the latter h higher. The printed
// angle is then tan α' = (b sin α + h cos α − h)/(b cos α − h sin α): the paper is off by h sin α/b
// to first order.
TEST(FixtureLocate, UnequalLengthsTurnThePrintedFrame) {
  const double alpha = 0.02, b = 50.0, h = 20.0;
  Locators locators = readings_of({alpha / rad_per_deg, 0, 0}, {0, 0, 0});
  const Vector3 places[] = {{0, 0, 0}, {80, 0, 0}, {40, b, h}};
  for (std::size_t i = 0; i < 3; ++i) {
    locators[i].ideal_mm = places[i];
    locators[i].measured_mm = turned(Rx(alpha), places[i]);
  }
  const double printed = std::atan2(b * std::sin(alpha) + h * std::cos(alpha) - h,
                                    b * std::cos(alpha) - h * std::sin(alpha));
  EXPECT_NEAR(locate_as_printed(locators).alpha_rad, printed, 1e-13);
  EXPECT_NEAR(locate_rigidly(locators).errors[3], alpha, 1e-13);
  EXPECT_NEAR(printed - alpha, alpha * alpha * h / (2.0 * b), 2.0 * std::pow(alpha, 3));
}

TEST(FixtureLocate, LocatorsThatDoNotTellAreNamed) {
  const Locators good = readings_of({0.1, 0.1, 0.1}, {0, 0, 0});
  const auto says = [](const Locators& locators, const std::string& text) {
    const auto troubles = locator_troubles(locators);
    EXPECT_THROW(locate_rigidly(locators), InputError);
    EXPECT_THROW(locate_as_printed(locators), InputError);
    std::string all;
    for (const LocatorTrouble& trouble : troubles) all += trouble.message + '\n';
    EXPECT_NE(all.find(text), std::string::npos) << text << " in:\n" << all;
  };
  EXPECT_TRUE(locator_troubles(good).empty());
  Locators bad = good;
  bad[1] = good[0];
  says(bad, "B coincides with A (as they should be)");
  bad = good;
  bad[4].measured_mm = good[3].measured_mm;
  says(bad, "E coincides with D (as they are measured)");
  bad = good;
  for (std::size_t k = 0; k < 3; ++k)
    bad[2].ideal_mm[k] = 0.5 * (good[0].ideal_mm[k] + good[1].ideal_mm[k]);
  says(bad, "A, B and C are collinear");
  bad = good;
  bad[4].ideal_mm = {good[3].ideal_mm[0], good[3].ideal_mm[1], good[3].ideal_mm[2] + 40};
  says(bad, "D and E are not apart along X");
  bad = good;
  std::swap(bad[0].measured_mm, bad[1].measured_mm);
  says(bad, "B was measured where A should be");
  bad = good;
  std::swap(bad[1].measured_mm, bad[4].measured_mm);
  says(bad, "E was measured where B should be");
  bad = good;
  for (Locator& locator : bad)
    for (double& x : locator.measured_mm) x /= 25.4;
  says(bad, "the measured tips do not match this fixture");
  bad = good;  // the side locators are 80 mm apart
  bad[4].ideal_mm[1] += 300.0;
  EXPECT_THROW(locate_as_printed(bad), InputError);
}

}  // namespace
}  // namespace trueaxis::testing
