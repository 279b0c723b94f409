// SPDX-License-Identifier: Apache-2.0
// A part on its own datum surfaces: by what D must do with them, and by six contacts.
#include <gtest/gtest.h>

#include "fixture/files/setup_input.hpp"
#include "support/random_fixture.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::testing {
namespace {

constexpr double rounding = 1e-12;  // of offsets below 1 mm and unit vectors

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Matrix4 matrix(const RigidTransform& D) {
  Matrix4 m = unit_matrix();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = D.rotation[i][j];
    m[i][3] = D.origin_mm[i];
  }
  return m;
}

// Seen in the fixture, XY is the plane z = 0, ZX holds the x axis, and all three the origin.
TEST(FixtureDatum, DatumSurfacesLieOnTheFixture) {
  constexpr unsigned seed = 1211;
  FixtureDraw draw(seed);
  for (int i = 0; i < 500; ++i) {
    const DatumErrors datums = draw.datums(0.8, 0.1);
    const Matrix4 D = matrix(setup_of_datums(datums).fixture_from_part);
    for (std::size_t k = 0; k < 3; ++k) {
      Vector3 point{};
      point[k] = datums.offset_mm[k];
      const Vector3 n = turned(D, FixtureDraw::normal(datums, k));
      ASSERT_NEAR(dot(n, FixtureDraw::transformed(D, point)), 0.0, rounding) << "seed " << seed;
      if (k == 2) {
        ASSERT_NEAR(n[2], 1.0, rounding) << "seed " << seed;
      }
      if (k == 1) {
        ASSERT_NEAR(n[0], 0.0, rounding) << "seed " << seed;
        ASSERT_GT(n[1], 0.0);
      }
    }
  }
}

// Perfect locators whose side tips are on the edges of the fixture's planes carry the datum
// system itself: D and E on the x axis, F at the origin.
TEST(FixtureDatum, SixContactsOnTheFixturesPlanesSayTheSame) {
  constexpr unsigned seed = 1212;
  FixtureDraw draw(seed);
  for (int i = 0; i < 100; ++i) {
    const DatumErrors datums = draw.datums(0.8, 0.1);
    const Vector3 tips[] = {{15, 12, 0}, {105, 12, 0}, {60, 68, 0}, {20, 0, 0}, {100, 0, 0}, {}};
    Locators locators;
    for (std::size_t l = 0; l < locator_count; ++l) locators[l] = {tips[l], tips[l], 1e-3};
    ASSERT_LT(difference(locate_rigidly(locators, datums).fixture_from_part,
                         matrix(setup_of_datums(datums).fixture_from_part)),
              1e-11)
        << "seed " << seed << ", case " << i;
  }
}

// To first order X0W … C0W = −(Exx, Eyy, Ezz, Ezx, Ezy, Eyz): the other three angles turn a datum
// within what the ones before it leave, and act in second order only.
TEST(FixtureDatum, ThreeAnglesActInSecondOrder) {
  constexpr double small = 1e-4;
  const char* const six[] = {"Exx", "Eyy", "Ezz", "Ezx", "Ezy", "Eyz"};
  for (std::size_t i = 0; i < 6; ++i) {
    DatumErrors one;
    datum_error(one, six[i]) = small;
    const PartSetup setup = setup_of_datums(one);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(setup.errors[k], k == i ? -small : 0.0, 2.0 * small * small) << six[i];
  }
  for (const char* const name : {"Eyx", "Exy", "Exz"}) {
    DatumErrors one;
    datum_error(one, name) = small;
    for (const double error : setup_of_datums(one).errors) EXPECT_NEAR(error, 0.0, 1e-15) << name;
    one.offset_mm = {1.0, 1.0, 1.0};
    double most = 0.0;
    const PartSetup with = setup_of_datums(one);
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(with.errors[k] + 1.0));
    EXPECT_NEAR(most, small, 0.1 * small) << name << " beside an offset of 1 mm";
  }
}

TEST(FixtureDatum, ParallelDatumsAreNamed) {
  DatumErrors datums;
  datum_error(datums, "Ezx") = -45.0 * rad_per_deg * 0.999;  // XY towards +Y, ZX towards +Z
  datum_error(datums, "Eyx") = 45.0 * rad_per_deg * 0.999;
  ASSERT_EQ(datum_troubles(datums).size(), 1U);
  EXPECT_EQ(datum_troubles(datums)[0].message.substr(0, 30), "datums XY and ZX are parallel:");
  EXPECT_THROW(setup_of_datums(datums), InputError);
  datum_error(datums, "Eyx") = 0.0;
  EXPECT_TRUE(datum_troubles(datums).empty());
  datum_error(datums, "Exz") = 57.0;  // degrees taken for rad
  ASSERT_FALSE(datum_troubles(datums).empty());
  EXPECT_EQ(datum_troubles(datums)[0].plane, 0U);
}

/// Points of plane k in the design frame, `noise_mm` along the axis.
std::vector<Vector3> points_of(FixtureDraw& draw, const DatumErrors& datums, std::size_t k,
                               double noise_mm, int count) {
  const Vector3 n = FixtureDraw::normal(datums, k);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    Vector3 p{};
    for (std::size_t j = 0; j < 3; ++j)
      if (j != k) p[j] = draw.within(5, 90);
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    p[k] = datums.offset_mm[k] - (n[a] * p[a] + n[b] * p[b]) / n[k];
    double noise = 0.0;
    for (int m = 0; m < 12; ++m) noise += draw.within(-0.5, 0.5);  // variance 1
    p[k] += noise_mm * noise;
    points.push_back(p);
  }
  return points;
}

double truth(const DatumErrors& datums, std::size_t k, std::size_t i) {
  return datum_error(datums, datum_error_names[3 * (2 - k) + i]);
}

TEST(FixtureDatum, PointsOfAPlaneGiveItsErrors) {
  constexpr unsigned seed = 1213;
  FixtureDraw draw(seed);
  for (int i = 0; i < 50; ++i) {
    const DatumErrors datums = draw.datums(0.8, 0.05);
    for (std::size_t k = 0; k < 3; ++k) {
      const ProbedDatum probed = fit_datum(k, points_of(draw, datums, k, 0.0, 12), "points");
      for (std::size_t e = 0; e < 3; ++e)
        ASSERT_NEAR(probed.errors[e], truth(datums, k, e), 1e-10)
            << datum_error_names[3 * (2 - k) + e] << ", seed " << seed;
    }
  }
}

// 900 values of planes of 4, 5, 8 and 20 points against their own u: within 2 u in 95.45 % of them,
// however few degrees of freedom σ has. Of 4 points it was 68 %. Those of a plane are correlated,
// so that the count spreads as 300 independent ones at most: 3 σ is 3.6 %.
TEST(FixtureDatum, UncertaintyOfPointsCovers) {
  constexpr unsigned seed = 1214;
  FixtureDraw draw(seed);
  for (const int points : {4, 5, 8, 20}) {
    int inside = 0;
    for (int i = 0; i < 100; ++i) {
      const DatumErrors datums = draw.datums(0.8, 0.01);
      for (std::size_t k = 0; k < 3; ++k) {
        const ProbedDatum probed = fit_datum(k, points_of(draw, datums, k, 2e-3, points), "points");
        for (std::size_t e = 0; e < 3; ++e)
          inside +=
              std::abs(probed.errors[e] - truth(datums, k, e)) <= 2.0 * probed.covariance.u(e);
      }
    }
    EXPECT_NEAR(inside / 900.0, 0.9545, 0.036) << points << " points, seed " << seed;
  }
}

// ISO 5459: a face that leans is where a plane square to the datums before it fits its points best.
// That of y = 0.001 z, probed at z = 20, 30, 40, is y = 0.03 if XY is true, and turns with XY.
TEST(FixtureDatum, ALaterDatumIsSquareToThoseBeforeIt) {
  std::vector<Vector3> zx, yz;
  for (const double a : {10.0, 45.0, 80.0})
    for (const double z : {20.0, 30.0, 40.0}) {
      zx.push_back({a, 0.001 * z, z});
      yz.push_back({0.002 * (a - 45.0) - 0.004, a, z});
    }
  DatumErrors datums;
  ProbedDatum side = fit_datum_after(datums, 1, zx, "zx");
  EXPECT_NEAR(side.errors[0], 0.03, 1e-12);
  EXPECT_NEAR(side.errors[1], 0.0, 1e-12);
  EXPECT_NEAR(side.errors[2], 0.0, 1e-12);
  EXPECT_NEAR(fit_datum(1, zx, "zx").errors[0], 0.0, 1e-12);
  EXPECT_NEAR(fit_datum_after(datums, 0, yz, "yz").errors[0], -0.004, 1e-12);
  // If the top leans as the face does, the face is square again, to second order.
  datum_error(datums, "Ezx") = -0.001;
  side = fit_datum_after(datums, 1, zx, "zx");
  EXPECT_NEAR(side.errors[0], 0.0, 1e-4);
  EXPECT_NEAR(std::abs(side.errors[1]), 0.001, 1e-6);
  datum_error(datums, "Eyx") = side.errors[1];
  datum_error(datums, "Eyz") = side.errors[2];
  EXPECT_NEAR(dot(datums.normal(1), datums.normal(2)), 0.0, 1e-12);
}

// Points of three planes that are square to each other, with noise: what the errors are off by is
// within 2 u in 95.45 % of 900 values. Those of a part are correlated: 3 σ of 300 is 3.6 %.
TEST(FixtureDatum, UncertaintyOfLaterDatumsCovers) {
  constexpr unsigned seed = 1216;
  FixtureDraw draw(seed);
  int inside = 0;
  for (int i = 0; i < 100; ++i) {
    DatumFile part;
    for (std::size_t k = 3; k-- > 0;) {
      part.probed[k] = fit_datum_after(part.datums, k, points_of(draw, {}, k, 2e-3, 12), "points");
      for (std::size_t e = 0; e < 3; ++e)
        datum_error(part.datums, datum_error_names[3 * (2 - k) + e]) = part.probed[k]->errors[e];
    }
    const Covariance all = part.covariance();
    for (std::size_t e = 0; e < 9; ++e)
      inside += std::abs(datum_error(part.datums, datum_error_names[e])) <= 2.0 * all.u(e);
  }
  EXPECT_NEAR(inside / 900.0, 0.9545, 0.036) << "seed " << seed;
}

// Propagated to D: nine errors with a covariance against central differences of the test.
TEST(FixtureDatum, UncertaintyGoesIntoTheSetup) {
  constexpr unsigned seed = 1215;
  FixtureDraw draw(seed);
  const DatumErrors datums = draw.datums(0.8, 0.05);
  Covariance covariance({datum_error_names.begin(), datum_error_names.end()});
  double u[9];
  for (std::size_t i = 0; i < 9; ++i) {
    u[i] = i % 3 == 0 ? draw.within(1e-3, 2e-3) : draw.within(1e-5, 5e-5);
    covariance(i, i) = u[i] * u[i];
  }
  const PartSetup setup = setup_of_datums(datums, covariance);
  for (std::size_t e = 0; e < 6; ++e) {
    double variance = 0.0;
    for (std::size_t i = 0; i < 9; ++i) {
      DatumErrors low = datums, high = datums;
      datum_error(low, datum_error_names[i]) -= u[i];
      datum_error(high, datum_error_names[i]) += u[i];
      const double half = 0.5 * (setup_of_datums(high).errors[e] - setup_of_datums(low).errors[e]);
      variance += half * half;
    }
    EXPECT_NEAR(setup.u(e) / std::sqrt(variance), 1.0, 1e-6) << "seed " << seed;
  }
  EXPECT_TRUE(std::isnan(setup_of_datums(datums).u(0)));
}

TEST(FixtureDatum, PointsOnALineAreNoPlane) {
  std::vector<Vector3> points;
  for (int i = 0; i < 8; ++i) points.push_back({1.0 * i, 2.0 * i, 0.0});
  EXPECT_THROW(fit_datum(2, points, "line.csv"), InputError);
  EXPECT_THROW(fit_datum(2, std::span(points).first(2), "two.csv"), InputError);
}

}  // namespace
}  // namespace trueaxis::testing
