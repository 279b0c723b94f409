// SPDX-License-Identifier: Apache-2.0
// Cones whose points lie on a short arc: the search may come to them the other way round.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "trueaxis/association.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// 40 points with 3 µm of noise on an arc of 1 rad of a cone. The least squares are less than those
// of the cone that was drawn. Some of the 300 were "turned inside out",
// or had a half angle of a turn more.
TEST(AssociationOfACone, OnAShortArcIsFound) {
  constexpr double half_angle = 11.0 * rad_per_deg, radius_mm = 12.0, arc_rad = 1.0;
  const double c = std::cos(half_angle), s = std::sin(half_angle), t = s / c;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 3e-3);
    std::uniform_real_distribution<double> along(-15.0, 15.0), around(0.0, arc_rad);
    std::vector<Point3> points;
    double of_truth = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double z = along(random), angle = around(random), r = radius_mm + t * z;
      const double x = r * std::cos(angle) + noise(random), y = r * std::sin(angle) + noise(random);
      const double h = z + noise(random);
      points.push_back({x, y, h});
      of_truth += std::pow(c * std::hypot(x, y) - s * h - c * radius_mm, 2);
    }
    const AssociatedFeature of = associate(points, Element::cone, Criterion::gaussian);
    ASSERT_EQ(of.status, AssociationStatus::converged) << of.why << ", seed " << seed;
    EXPECT_LE(40.0 * of.rms_mm * of.rms_mm, of_truth) << "seed " << seed;
    EXPECT_GT(of.feature.radius_mm, 0.0) << "seed " << seed;
    EXPECT_LT(of.feature.half_angle_rad, 90.0 * rad_per_deg) << "seed " << seed;
  }
}

}  // namespace
}  // namespace trueaxis
