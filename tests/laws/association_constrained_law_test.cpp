// SPDX-License-Identifier: Apache-2.0
// The least sum of squares outside of the material: all points on its side, the balance of all
// points against those that it touches, never worse than the Gaussian element moved out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "associate/nearest_surface.hpp"
#include "trueaxis/association.hpp"

namespace trueaxis {
namespace {

std::vector<Point3> rough(Element element, std::size_t count, unsigned seed) {
  std::mt19937_64 engine(seed);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  std::vector<Point3> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = draw(0.0, 2.0 * std::numbers::pi), u = draw(-15.0, 15.0);
    const double d = draw(-0.02, 0.02), r = element == Element::cone ? 10.0 + 0.3 * u : 10.0;
    if (element == Element::plane)
      out.push_back({u + 0.1 * d, draw(-10.0, 10.0), 0.2 * u + d});
    else if (element == Element::sphere)
      out.push_back({(r + d) * std::sqrt(1.0 - u * u / 225.0) * std::cos(t),
                     (r + d) * std::sqrt(1.0 - u * u / 225.0) * std::sin(t), (r + d) * u / 15.0});
    else
      out.push_back({(r + d) * std::cos(t) + 3.0, (r + d) * std::sin(t) - 1.0,
                     element == Element::circle ? 0.0 : u});
  }
  return out;
}

constexpr Element with_sides[] = {Element::circle, Element::plane, Element::sphere,
                                  Element::cylinder, Element::cone};

TEST(AssociationConstrainedLaw, AllPointsPressOnTheElementAsThoseThatTouchItPressBack) {
  for (const Element element : with_sides) {
    for (const Material material : {Material::inside, Material::outside}) {
      for (const std::size_t count : {40UL, 5000UL}) {
        SCOPED_TRACE(std::string(element_names[static_cast<std::size_t>(element)]) + ", " +
                     std::to_string(count) + " points");
        const std::vector<Point3> points = rough(element, count, 5);
        const AssociatedFeature got =
            associate(points, element, Criterion::constrained, {.material = material});
        ASSERT_EQ(got.status, AssociationStatus::converged) << got.why;
        const double sign = material == Material::inside ? 1.0 : -1.0;
        Point3 force{}, moment{};
        double size = 0.0;
        const auto press = [&](const Point3& point, double weight) {
          const NearestSurface at = nearest_surface(got, point);
          for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            force[i] += weight * at.normal[i];
            moment[i] += weight * (at.arm_mm[j] * at.normal[k] - at.arm_mm[k] * at.normal[j]);
          }
          size += weight;
        };
        const std::vector<double> distances = distances_mm(points, got);
        for (std::size_t i = 0; i < count; ++i) {
          EXPECT_LE(sign * distances[i], 1e-12);
          press(points[i], distances[i] / static_cast<double>(count));
        }
        for (const auto& contact : got.certificate.contacts) {
          EXPECT_GT(contact.multiplier, 0.0);
          EXPECT_NEAR(distances[contact.point], 0.0, 1e-12);
          press(points[contact.point], sign * contact.multiplier);
        }
        // Sums of some 10 mm × 0.02 mm, to a few hundred roundings of points of 20 mm.
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(force[i], 0.0, 1e-12);
          EXPECT_NEAR(moment[i], 0.0, 1e-11);
        }
        EXPECT_NEAR(size, 0.0, 1e-12);
        const AssociatedFeature gaussian = associate(points, element, Criterion::gaussian);
        const std::vector<double> free = distances_mm(points, gaussian);
        const double out =
            sign > 0.0 ? *std::ranges::max_element(free) : *std::ranges::min_element(free);
        double moved = 0.0;
        for (const double d : free) moved += (d - out) * (d - out);
        EXPECT_LT(gaussian.rms_mm, got.rms_mm);
        EXPECT_LE(got.rms_mm, std::sqrt(moved / static_cast<double>(count)) + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace trueaxis
