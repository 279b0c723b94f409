// SPDX-License-Identifier: Apache-2.0
// Quantiles of the coaxiality against distributions that have a closed form. Tolerances: 2¹⁴ points
// of Sobol's sequence miss a probability by about 1/2¹⁴ to a few of them; a factor of 10 is
// allowed, divided by the density where a quantile is meant.
#include "correct/coaxiality_distribution.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

namespace trueaxis {
namespace {

constexpr double probability_error = 1e-3, relative = 4e-3;

Reference seat(double u_x, double u_y, double u_slope = 0.0) {
  Reference out;
  out.name = "seat";
  auto& c = out.axis.covariance.by_rows;
  c[0] = u_x * u_x, c[5] = u_y * u_y, c[10] = c[15] = u_slope * u_slope;
  return out;
}

double quantile(const Reference& r, const Axis& target, double p, double z0 = 0.0,
                double z1 = 0.0) {
  return CoaxialityDistribution({&r, 1}, target, z0, z1).quantile(p);
}

TEST(CoaxialityDistribution, IsRayleighWhereNothingIsLeftAndBothComponentsAreEqual) {
  const double u = 3e-4;
  for (const double p : {0.05, 0.5, 0.865, 0.95})
    EXPECT_NEAR(quantile(seat(u, u), {}, p), 2.0 * u * std::sqrt(-2.0 * std::log1p(-p)),
                relative * 2.0 * u * 2.45)
        << p;
  // So twice u in the worse direction, doubled for the diameter, covers 86.5 %.
  const Reference r = seat(u, u);
  EXPECT_NEAR(CoaxialityDistribution({&r, 1}, {}, 0.0, 0.0).within(2.0 * 2.0 * u),
              1.0 - std::exp(-2.0), probability_error);
}

TEST(CoaxialityDistribution, IsHalfNormalInOneDirection) {
  const boost::math::normal normal;
  EXPECT_NEAR(quantile(seat(1e-3, 0.0), {}, 0.95), 2e-3 * boost::math::quantile(normal, 0.975),
              relative * 2e-3 * 1.96);
}

TEST(CoaxialityDistribution, OfSomethingLeftIsRice) {
  const double u = 1e-3, left = 2.5e-3;
  const boost::math::non_central_chi_squared rice(2.0, left * left / (u * u));
  for (const double p : {0.05, 0.95}) {
    EXPECT_NEAR(quantile(seat(u, u), {.x_mm = -left}, p),
                2.0 * u * std::sqrt(boost::math::quantile(rice, p)), relative * 2.0 * left)
        << p;
  }
}

// Where both are does not matter, nor how both lean.
TEST(CoaxialityDistribution, IsOfTheDifferenceOfReferenceAndTarget) {
  const double u = 1e-3;
  Reference there = seat(u, u, 2e-5), here = there;
  here.axis.axis = {2e-3, -1e-3, 1e-5, 3e-5, 0.0};
  there.axis.axis = {2e-3 + 0.4, -1e-3 + 0.3, 1e-5 + 2e-3, 3e-5 - 1e-3, 0.0};
  const Axis target{0.4, 0.3, 2e-3, -1e-3, 0.0};
  for (const double p : {0.05, 0.5, 0.95})
    EXPECT_NEAR(quantile(there, target, p, 10.0, 40.0), quantile(here, {}, p, 10.0, 40.0), 1e-12);
  here.face_radius_mm = there.face_radius_mm = 30.0;
  EXPECT_NEAR(quantile(there, target, 0.95), quantile(here, {}, 0.95), 1e-12);
}

TEST(CoaxialityDistribution, OfTheWorseOfTwoReferencesIsTheProductOfTheirs) {
  const double u = 1e-3;
  const Reference both[] = {seat(u, u), seat(u, u)};
  const double one = 1.0 - std::exp(-0.5 * 2.0 * 2.0);  // within 2 u, a diameter of 4 u
  EXPECT_NEAR(CoaxialityDistribution(both, {}, 0.0, 0.0).within(4.0 * u), one * one,
              probability_error);
}

TEST(CoaxialityDistribution, OfOppositeEndsOfAnAxisThatTiltsIsThatOfItsSlope) {
  // About the middle both ends move by the same: u = 50 mm × u_slope, at either end.
  const double u_slope = 1e-5;
  EXPECT_NEAR(quantile(seat(0.0, 0.0, u_slope), {}, 0.95, -50.0, 50.0),
              2.0 * 50.0 * u_slope * std::sqrt(-2.0 * std::log(0.05)),
              relative * 2.0 * 50.0 * u_slope * 2.45);
}

TEST(CoaxialityDistribution, WithFewDegreesOfFreedomIsFishersF) {
  Reference r = seat(1e-3, 1e-3);
  r.freedom = 20.0;
  const boost::math::fisher_f f(2.0, 20.0);
  // Wilson and Hilferty's χ² is good to some 1e-3 of itself at 20 degrees of freedom.
  EXPECT_NEAR(quantile(r, {}, 0.95), 2e-3 * std::sqrt(2.0 * boost::math::quantile(f, 0.95)),
              2.0 * relative * 2e-3 * 2.6);
}

TEST(CoaxialityDistribution, OfAFaceIsItsRunOut) {
  Reference r = seat(7.0, 7.0, 1e-5);  // its position counts for nothing
  r.face_radius_mm = 40.0;
  EXPECT_NEAR(quantile(r, {}, 0.95), 2.0 * 40.0 * 1e-5 * std::sqrt(-2.0 * std::log(0.05)),
              relative * 8e-4 * 2.45);
}

TEST(CoaxialityDistribution, WithoutAnUncertaintyThereIsNone) {
  Reference r = seat(1e-3, 1e-3);
  r.axis.covariance.by_rows[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(quantile(r, {}, 0.95)));
}

TEST(CoaxialityDistribution, IsTheSameEveryTime) {
  const Reference r = seat(1e-3, 2e-3, 1e-5);
  EXPECT_EQ(quantile(r, {}, 0.95, 0.0, 30.0), quantile(r, {}, 0.95, 0.0, 30.0));
}

// Beyond the last of 2¹⁴ points there is nothing to interpolate.
TEST(CoaxialityDistribution, EndsAtItsLargestDraw) {
  const Reference r = seat(1e-3, 5e-4);
  const CoaxialityDistribution distribution({&r, 1}, {}, 0.0, 0.0);
  const double largest_mm = distribution.quantile(1.0);
  EXPECT_EQ(largest_mm, distribution.quantile(1.0 - 1e-6));
  EXPECT_EQ(distribution.within(largest_mm), 1.0);
  EXPECT_LT(distribution.within(std::nextafter(largest_mm, 0.0)), 1.0);
  EXPECT_EQ(distribution.quantile(0.0), distribution.quantile(1e-6));
}

}  // namespace
}  // namespace trueaxis
