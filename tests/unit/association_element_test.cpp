// SPDX-License-Identifier: Apache-2.0
// Cones whose points lie on a short arc: the search may come to them the other way round. Points
// that are those of another element.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

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

/// 400 points (mm) of a surface r(z), 0 ≤ z ≤ 40, with 2 µm of noise.
template <typename Radius>
std::vector<Point3> turned(Radius radius_mm) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 2e-3);
  std::uniform_real_distribution<double> along(0.0, 40.0), around(0.0, two_pi);
  std::vector<Point3> points;
  for (int i = 0; i < 400; ++i) {
    const double z = along(random), angle = around(random), r = radius_mm(z) + noise(random);
    points.push_back({r * std::cos(angle), r * std::sin(angle), z});
  }
  return points;
}

std::string objection(const std::vector<Point3>& points, Element element) {
  return of_other_element(points, associate(points, element, Criterion::gaussian));
}

// A cylinder "was" a sphere with a radius of 22.95 ± 0.25 mm, with exit code 0.
TEST(OtherElement, IsNamedIfItLeavesATenthOrLess) {
  const std::vector<Point3> cylinder = turned([](double) { return 20.0; });
  const std::vector<Point3> cone = turned([](double z) { return 20.0 + 0.2 * z; });
  const std::vector<Point3> ball =
      turned([](double z) { return std::sqrt(900.0 - (z - 20.0) * (z - 20.0)); });
  EXPECT_NE(objection(cylinder, Element::sphere).find("off a cylinder"), std::string::npos);
  EXPECT_NE(objection(cylinder, Element::plane).find("off a cylinder"), std::string::npos);
  EXPECT_NE(objection(cone, Element::cylinder).find("off a cone"), std::string::npos);
  EXPECT_NE(objection(ball, Element::cylinder).find("off a sphere"), std::string::npos);
  EXPECT_EQ(objection(cylinder, Element::cylinder), "");
  EXPECT_EQ(objection(cylinder, Element::cone), "");
  EXPECT_EQ(objection(cone, Element::cone), "");
  EXPECT_EQ(objection(ball, Element::sphere), "");
}

// No element leaves a tenth of 200 µm of three lobes, which a part may have.
TEST(OtherElement, IsNotTheFormOfAPart) {
  std::vector<Point3> lobed = turned([](double) { return 20.0; });
  for (Point3& p : lobed) {
    const double scale = 1.0 + 0.01 * std::cos(3.0 * std::atan2(p[1], p[0]));
    p[0] *= scale, p[1] *= scale;
  }
  EXPECT_EQ(objection(lobed, Element::cylinder), "");
  for (Point3& p : lobed) p[0] *= 1.5;
  EXPECT_NE(objection(lobed, Element::cylinder).find("no part of that size"), std::string::npos);
}

}  // namespace
}  // namespace trueaxis
