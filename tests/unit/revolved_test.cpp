// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "surface/revolved_kernel.hpp"
#include "trueaxis/surface.hpp"

namespace trueaxis {
namespace {

constexpr double pi = std::numbers::pi;

// Distance of a point of the part from the axis minus the radius there; an own formulation (cross
// product), not that of `intersect`.
double form_error(const Revolved& surface, double x_mm, double c_rad, double z_mm, double h_mm) {
  const double px = x_mm * std::cos(c_rad) - h_mm * std::sin(c_rad) - surface.axis.x_mm;
  const double py = x_mm * std::sin(c_rad) + h_mm * std::cos(c_rad) - surface.axis.y_mm;
  const double pz = z_mm - surface.axis.z_ref_mm;
  const double n =
      1.0 / std::sqrt(1.0 + std::pow(surface.axis.slope_x, 2) + std::pow(surface.axis.slope_y, 2));
  const double l = surface.axis.slope_x * n, m = surface.axis.slope_y * n;
  const double cross = std::hypot(py * n - pz * m, pz * l - px * n, px * m - py * l);
  const double s = px * l + py * m + pz * n;
  return cross - (surface.radius_mm + surface.tan_half_angle * s);
}

TEST(Intersect, EccentricCircleHasItsClosedForm) {
  const double radius = 20.0;
  for (const double e : {0.0, 0.2, 5.0, 19.9}) {
    const Revolved cylinder{{e, 0.0, 0.0, 0.0, 0.0}, radius, 0.0};
    for (double c = -7.0; c < 7.0; c += 0.37) {
      const double root = std::sqrt(radius * radius - std::pow(e * std::sin(c), 2));
      const Intersection front = intersect(cylinder, c, 12.0);
      const Intersection rear = intersect(cylinder, c, 12.0, 0.0, Root::rear);
      ASSERT_TRUE(front.hit && rear.hit);
      // Rounding of values of 40 mm over a few operations.
      EXPECT_NEAR(front.x_mm, e * std::cos(c) + root, 1e-13 * radius);
      EXPECT_NEAR(rear.x_mm, e * std::cos(c) - root, 1e-13 * radius);
      EXPECT_NEAR(front.dx_dz, 0.0, 1e-15);
    }
  }
}

TEST(Intersect, EccentricCircleHasTheHarmonicsOfTheCatalogue) {
  const double e = 0.2, radius = 40.0;
  const int m = 64;
  double dc = 0.0, h1 = 0.0, h2 = 0.0;
  for (int i = 0; i < m; ++i) {
    const double c = 2.0 * pi * i / m;
    const double x = intersect({{e, 0, 0, 0, 0}, radius, 0.0}, c, 0.0).x_mm - radius;
    dc += x / m, h1 += 2.0 * x * std::cos(c) / m, h2 += 2.0 * x * std::cos(2.0 * c) / m;
  }
  // Eq. 12: H1 = e, H2 = e²/(4R), DC = −e²/(4R); the next terms are e⁴/R³ ~ 3e-8.
  EXPECT_NEAR(h1, e, 1e-12);
  EXPECT_NEAR(h2, e * e / (4.0 * radius), 1e-8);
  EXPECT_NEAR(dc, -e * e / (4.0 * radius), 1e-8);
}

TEST(Intersect, HeightTurnsTheContactExactly) {
  const double radius = 15.0, h = 0.7, e = 0.4;
  const Revolved cylinder{{e, 0, 0, 0, 0}, radius, 0.0};
  const double straight = intersect({{0, 0, 0, 0, 0}, radius, 0.0}, 1.0, 0.0, h).x_mm;
  EXPECT_NEAR(straight, std::sqrt(radius * radius - h * h), 1e-13);
  for (double c = 0.0; c < 6.0; c += 0.5) {
    const double across = h + e * std::sin(c);
    EXPECT_NEAR(intersect(cylinder, c, 0.0, h).x_mm,
                e * std::cos(c) + std::sqrt(radius * radius - across * across), 1e-13 * radius);
  }
}

TEST(Intersect, LiesOnTheSurfaceWithTheDerivativesOfDifferences) {
  const unsigned seed = 20240611;
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const double half_angle = uniform(-80.0, 80.0) * pi / 180.0;
    const Revolved cone{{uniform(-30, 30), uniform(-30, 30), uniform(-0.02, 0.02),
                         uniform(-0.02, 0.02), uniform(-200, 200)},
                        uniform(5, 60),
                        i % 5 == 0 ? 0.0 : std::tan(half_angle)};
    const double c = uniform(-20, 20), z = uniform(-100, 100), h = uniform(-1, 1);
    const Root root = i % 2 == 0 ? Root::front : Root::rear;
    SCOPED_TRACE(::testing::Message() << "seed " << seed << " case " << i);
    const Intersection hit = intersect(cone, c, z, h, root);
    if (!hit.hit) continue;
    const double scale = 1.0 + std::abs(hit.x_mm) + std::abs(cone.tan_half_angle) * 300.0;
    const double slope = std::abs(hit.dx_dz) + std::abs(hit.dx_dc);
    if (slope > 50.0 * scale) continue;  // grazing: differences are of no use there
    ++hits;
    EXPECT_NEAR(form_error(cone, hit.x_mm, c, z, h), 0.0, 1e-11 * scale);
    // Five-point differences: truncation δ⁴ against rounding ε/δ, curvature grows towards grazing.
    const double delta = 1e-4;
    const auto x = [&](double dc, double dz) {
      return intersect(cone, c + dc, z + dz, h, root).x_mm;
    };
    const auto slope_of = [&](auto f) {
      return (8.0 * (f(delta) - f(-delta)) - (f(2 * delta) - f(-2 * delta))) / (12.0 * delta);
    };
    const double tolerance = 1e-7 * scale * (1.0 + slope);
    EXPECT_NEAR(hit.dx_dz, slope_of([&](double dz) { return x(0.0, dz); }), tolerance);
    EXPECT_NEAR(hit.dx_dc, slope_of([&](double dc) { return x(dc, 0.0); }), tolerance);
  }
  EXPECT_GT(hits, 1000) << "seed " << seed;
}

TEST(Intersect, SteepConesOpenEitherWayAndTheMirroredNappeIsRejected) {
  const double tan80 = std::tan(80.0 * pi / 180.0);
  for (const double t : {tan80, -tan80}) {
    const Revolved cone{{1.0, -2.0, 0.0, 0.0, 0.0}, 50.0, t};
    const double z_apex = -50.0 / t;
    for (double c = 0.0; c < 6.0; c += 0.4) {
      const double z = 3.0, radius = 50.0 + t * z;  // untilted: a section is a circle
      if (radius > 3.0) {
        const double along = std::cos(c) - 2.0 * std::sin(c);
        const double across = std::sin(c) + 2.0 * std::cos(c);
        EXPECT_NEAR(intersect(cone, c, z).x_mm,
                    along + std::sqrt(radius * radius - across * across), 1e-12 * radius);
      }
      const double beyond = z_apex - (t > 0.0 ? 4.0 : -4.0);
      EXPECT_FALSE(intersect(cone, c, beyond).hit);
      EXPECT_FALSE(intersect(cone, c, beyond, 0.0, Root::rear).hit);
    }
  }
}

// Through every point of a cone goes a line that meets the cone: there, or still farther out.
TEST(Intersect, MeetsEveryPointOfACone) {
  std::mt19937 random(20240612);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int there = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = std::tan(uniform(-80.0, 80.0) * pi / 180.0);
    const double lx = uniform(-0.3, 0.3), ly = uniform(-0.3, 0.3), n = std::hypot(1.0, lx, ly);
    const Revolved cone{{uniform(-9, 9), uniform(-9, 9), lx, ly, 20.0}, uniform(5, 60), t};
    // From the axis at height s by the radius there, at right angles to it.
    const double s = uniform(-50, 50), radius = cone.radius_mm + t * s, turned = uniform(-pi, pi);
    if (radius < 1.0) continue;
    const double e[3] = {1.0 / std::hypot(1.0, lx), 0.0, -lx / std::hypot(1.0, lx)};
    const double d[3] = {lx / n, ly / n, 1.0 / n};
    const double f[3] = {d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2],
                         d[0] * e[1] - d[1] * e[0]};
    double p[3] = {cone.axis.x_mm, cone.axis.y_mm, 20.0};
    for (int k = 0; k < 3; ++k)
      p[k] += s * d[k] + radius * (std::cos(turned) * e[k] + std::sin(turned) * f[k]);
    const double x = std::hypot(p[0], p[1]), c = std::atan2(p[1], p[0]);
    const Intersection front = intersect(cone, c, p[2]);
    const Intersection rear = intersect(cone, c, p[2], 0.0, Root::rear);
    const double rounding = 1e-6 * (1.0 + std::abs(t));  // √ε where the line grazes
    ASSERT_TRUE(front.hit && rear.hit) << i;
    EXPECT_GE(front.x_mm, x - rounding * x) << i;
    EXPECT_LE(rear.x_mm, x + rounding * x) << i;
    there += std::min(std::abs(front.x_mm - x), std::abs(rear.x_mm - x)) < rounding * x;
  }
  EXPECT_GT(there, 2000);
}

// If a cylinder is about the spindle √disc is r: the column of the radius is 1 to some bits, and
// the residual of X_M = 0 is −r to the last bit. No instruction set's first estimate shows.
TEST(RevolvedKernel, ItsRootIsExactToTheLastBit) {
  constexpr double bit = std::numeric_limits<double>::epsilon();
  std::vector<double> cosine, sine, z(block_size, 7.0), x(block_size, 0.0);
  for (std::size_t i = 0; i < block_size; ++i)
    cosine.push_back(std::cos(0.1 * static_cast<double>(i))),
        sine.push_back(std::sin(0.1 * static_cast<double>(i)));
  PredictionBlock out;
  for (double radius = 10.0; radius < 41.0; radius += 0.037) {  // two octaves of r²
    for (const Root root : {Root::front, Root::rear}) {
      const double side = root == Root::front ? 1.0 : -1.0;
      evaluate_revolved({{0.0, 0.0, 0.0, 0.0, 5.0}, radius, 0.0}, root, 0.0,
                        {x.data(), cosine.data(), sine.data(), z.data()}, out);
      ASSERT_TRUE(out.valid);
      for (std::size_t i = 0; i < block_size; ++i) {
        ASSERT_NEAR(out.column[w_r][i], side, 6.0 * bit) << radius;
        ASSERT_NEAR(out.residual[i], -side * radius, 1.25 * bit * radius) << radius;
      }
    }
  }
}

TEST(Intersect, ALineBesideTheSurfaceDoesNotHit) {
  const Revolved cylinder{{0, 0, 0, 0, 0}, 10.0, 0.0};
  EXPECT_FALSE(intersect(cylinder, 0.3, 0.0, 10.5).hit);
  EXPECT_FALSE(intersect(cylinder, 0.3, 0.0, -10.5).hit);
  EXPECT_TRUE(intersect(cylinder, 0.3, 0.0, 9.5).hit);
}

TEST(Intersect, RearRootIsTheFrontRootHalfATurnOn) {
  // At h = 0 the line at C + π is the same line, run the other way.
  const Revolved cone{{0.3, -0.1, 2e-3, 1e-3, 10.0}, 30.0, 0.2};
  for (double c = 0.0; c < 6.0; c += 0.7) {
    EXPECT_NEAR(intersect(cone, c, 40.0, 0.0, Root::rear).x_mm, -intersect(cone, c + pi, 40.0).x_mm,
                1e-12);
  }
}

TEST(AxisEstimate, UncertaintyIsThatOfTheWorseDirection) {
  AxisEstimate estimate{{0, 0, 0, 0, 10.0}, {}};
  estimate.covariance.by_rows = {4e-6, 0,    0, 0,  //
                                 0,    1e-6, 0, 0,  //
                                 0,    0,    0, 0,  //
                                 0,    0,    0, 1e-8};
  // At z_ref: x with u = 2 µm. 100 mm away: y with sqrt(1e-6 + 1e4·1e-8).
  EXPECT_NEAR(estimate.u_at(10.0), 2e-3, 1e-15);
  EXPECT_NEAR(estimate.u_at(110.0), std::sqrt(1.01e-4), 1e-12);
  // Fully correlated x and y: the worse direction is the diagonal, sqrt(2) larger.
  estimate.covariance.by_rows = {1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_NEAR(estimate.u_at(10.0), std::sqrt(2.0), 1e-12);
}

// A slope of 1e-3 towards x has that of x, although y is less well known; none has the worse.
TEST(AxisEstimate, UncertaintyOfATiltIsAlongIt) {
  AxisEstimate estimate{{0, 0, 1e-3, 0, 0.0}, {}};
  estimate.covariance.by_rows[10] = 1e-12;
  estimate.covariance.by_rows[15] = 4e-10;
  EXPECT_NEAR(estimate.u_tilt(), 1e-6, 1e-18);
  estimate.axis.slope_x = 0.0;
  EXPECT_NEAR(estimate.u_tilt(), 2e-5, 1e-17);
}

}  // namespace
}  // namespace trueaxis
