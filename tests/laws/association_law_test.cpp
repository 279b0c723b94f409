// SPDX-License-Identifier: Apache-2.0
// What an association must satisfy whatever the element: the balance of its certificate, the same
// element in another frame, unit and order, and the best one where all can be tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "associate/nearest_surface.hpp"
#include "trueaxis/association.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double pi = std::numbers::pi;

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Point3& a) { return std::sqrt(dot(a, a)); }

/// A rigid motion and a scale: x → s R x + t.
struct Motion3 {
  std::array<Point3, 3> rows{};
  Point3 shift{};
  double scale = 1.0;
  Point3 operator()(const Point3& p) const {
    Point3 out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = scale * dot(rows[i], p) + shift[i];
    return out;
  }
};

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Motion3 motion(double far, double scale) {
    double q[4], length = 0.0;
    for (double& c : q) c = std::normal_distribution<double>()(engine_), length += c * c;
    for (double& c : q) c /= std::sqrt(length);
    const auto [w, x, y, z] = q;
    return {{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
              {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
              {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}},
            {uniform(-far, far), uniform(-far, far), uniform(-far, far)},
            scale};
  }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

/// Points of an element about the z axis, up to `form` off it.
std::vector<Point3> points_on(Element element, std::size_t count, double form, Draw& draw) {
  std::vector<Point3> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = draw.uniform(0.0, 2.0 * pi), u = draw.uniform(-1.0, 1.0);
    const double d = draw.uniform(-form, form), c = std::cos(t), s = std::sin(t);
    const auto ring = [&](double r, double z) { out.push_back({r * c, r * s, z}); };
    switch (element) {
      case Element::line:
        ring(d, 40.0 * u);
        break;
      case Element::circle:
        ring(10.0 + d, form * draw.uniform(-1.0, 1.0));
        break;
      case Element::plane:
        out.push_back({30.0 * u, draw.uniform(-20.0, 20.0), d});
        break;
      case Element::sphere:
        ring((10.0 + d) * std::sqrt(1.0 - u * u), (10.0 + d) * u);
        break;
      case Element::cylinder:
        ring(10.0 + d, 15.0 * u);
        break;
      case Element::cone:
        ring(10.0 + 4.0 * u + d * std::cos(std::atan(0.4)),
             10.0 * u - d * std::sin(std::atan(0.4)));
        break;
      case Element::torus: {
        const double v = pi * u;
        ring(30.0 + (5.0 + d) * std::cos(v), (5.0 + d) * std::sin(v));
        break;
      }
    }
  }
  return out;
}

std::vector<Point3> moved_by(const Motion3& motion, std::vector<Point3> points) {
  for (Point3& point : points) point = motion(point);
  return points;
}

constexpr Element all_elements[] = {Element::line,   Element::circle,   Element::plane,
                                    Element::sphere, Element::cylinder, Element::cone,
                                    Element::torus};
constexpr Criterion extremes[] = {Criterion::minimum_zone, Criterion::minimum_circumscribed,
                                  Criterion::maximum_inscribed};

/// Parts of the balance that must be 0: a circle seen along its axis has no moments and no force
/// along it.
double imbalance(const AssociatedFeature& of, const std::vector<Point3>& points) {
  const Balance balance = balance_of(of, points);
  const bool seen_along_axis =
      of.element == Element::circle && of.criterion != Criterion::minimum_zone;
  double worst = norm(balance.force);
  if (seen_along_axis) {
    const double along = dot(balance.force, of.feature.direction);
    return std::sqrt(std::max(0.0, worst * worst - along * along));
  }
  worst = std::max(worst, norm(balance.moment_mm) / 10.0);
  const bool tube = of.element == Element::line || of.element == Element::circle;
  if (of.criterion == Criterion::minimum_zone && !tube)
    worst = std::max(worst, std::abs(balance.size));
  if (of.element == Element::cone) worst = std::max(worst, std::abs(balance.second_size) / 10.0);
  if (of.element == Element::torus || of.element == Element::circle)
    worst = std::max(worst, std::abs(balance.second_size));
  return worst;
}

TEST(AssociationLaw, ContactsAreInEquilibriumAndNoPointIsBeyond) {
  int compared = 0;
  for (const Element element : all_elements) {
    for (const Criterion criterion : extremes) {
      if (!association_objection(element, criterion).empty()) continue;
      for (unsigned seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(std::string(element_names[static_cast<std::size_t>(element)]) + " " +
                     criterion_names[static_cast<std::size_t>(criterion)] + ", seed " +
                     std::to_string(seed));
        Draw draw(seed);
        const auto points = moved_by(draw.motion(50.0, 1.0), points_on(element, 60, 0.02, draw));
        const AssociatedFeature got = associate(points, element, criterion);
        ASSERT_EQ(got.status, AssociationStatus::converged) << got.why;
        // Rounding of coordinates of 50 mm, 1e-14, over the curvature of contacts near each other.
        EXPECT_LE(imbalance(got, points), 1e-9);
        double sum = 0.0;
        const std::vector<double> distances = distances_mm(points, got);
        const auto [low, high] = std::ranges::minmax(distances);
        for (const auto& contact : got.certificate.contacts) {
          EXPECT_GT(contact.multiplier, 0.0);
          sum += contact.multiplier;
          EXPECT_NEAR(contact.distance_mm, distances[contact.point], 1e-12);
          EXPECT_NEAR(distances[contact.point], contact.sign > 0 ? high : low, 1e-12);
        }
        EXPECT_NEAR(sum, 1.0, 1e-12);
        if (criterion != Criterion::minimum_zone) {  // the size is that of the points it rests on
          EXPECT_NEAR(criterion == Criterion::maximum_inscribed ? low : high, 0.0, 1e-12);
        }
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 6 * (7 + 2 * 4));  // seeds; zones of all, sizes of those that have one
}

TEST(AssociationLaw, TheSameElementInAnotherFrameUnitAndOrder) {
  int compared = 0;
  for (const Element element : all_elements) {
    for (std::size_t c = 0; c < criterion_names.size(); ++c) {
      const auto criterion = static_cast<Criterion>(c);
      if (!association_objection(element, criterion).empty()) continue;
      if (criterion == Criterion::constrained && element == Element::line) continue;  // no side
      for (const double scale : {1e-3, 1.0, 1e4}) {
        SCOPED_TRACE(std::string(element_names[static_cast<std::size_t>(element)]) + " " +
                     criterion_names[c] + ", scale " + std::to_string(scale));
        Draw draw(11);
        const std::vector<Point3> points = points_on(element, 50, 0.02, draw);
        const Motion3 motion = draw.motion(100.0 * scale, scale);
        std::vector<Point3> others = moved_by(motion, points);
        std::ranges::shuffle(others, draw.engine());
        // Twice the same point is nothing new to extremes, but for the plane of a circle in space.
        const bool twice = criterion != Criterion::gaussian &&
                           criterion != Criterion::constrained && element != Element::circle;
        if (twice) others.insert(others.end(), others.begin(), others.begin() + 10);
        const AssociatedFeature a = associate(points, element, criterion);
        const AssociatedFeature b = associate(others, element, criterion);
        ASSERT_EQ(a.status, AssociationStatus::converged) << a.why;
        ASSERT_EQ(b.status, AssociationStatus::converged) << b.why;
        // Coordinates of 100 × scale are rounded to 1e-14 of it.
        EXPECT_NEAR(b.zone_mm, scale * a.zone_mm, 1e-11 * scale);
        const auto turned = motion(a.feature.point_mm);
        double apart = 0.0;
        for (std::size_t i = 0; i < 3; ++i) apart += std::pow(turned[i] - b.feature.point_mm[i], 2);
        // They move the centroid, and with it the point of an axis along it.
        if (!twice) {
          EXPECT_LE(std::sqrt(apart), 1e-9 * scale);
        }
        if (std::isfinite(a.feature.radius_mm) && element != Element::cone) {
          EXPECT_NEAR(b.feature.radius_mm, scale * a.feature.radius_mm, 1e-9 * scale);
        }
        if (std::isfinite(a.feature.half_angle_rad)) {
          EXPECT_NEAR(b.feature.half_angle_rad, a.feature.half_angle_rad, 1e-10);
        }
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 3 * (7 + 7 + 2 * 4 + 6));  // scales; Gaussian, zones, sizes, one side
}

TEST(AssociationLaw, ExactPointsGiveTheElementBack) {
  int compared = 0;
  for (const Element element : all_elements) {
    for (std::size_t c = 0; c < criterion_names.size(); ++c) {
      const auto criterion = static_cast<Criterion>(c);
      if (!association_objection(element, criterion).empty()) continue;
      if (criterion == Criterion::constrained && element == Element::line) continue;  // no side
      SCOPED_TRACE(element_names[static_cast<std::size_t>(element)]);
      Draw draw(21);
      const auto points = moved_by(draw.motion(100.0, 1.0), points_on(element, 30, 0.0, draw));
      const AssociatedFeature got = associate(points, element, criterion);
      ASSERT_EQ(got.status, AssociationStatus::converged) << got.why;
      EXPECT_LE(got.zone_mm, 1e-12);  // a hundred roundings of 100 mm
      ++compared;
    }
  }
  EXPECT_EQ(compared, 7 + 7 + 2 * 4 + 6);
}

/// All that a best circle of the plane may rest on: its centre is equally far from two pairs.
std::vector<Point3> centres_of(const std::vector<Point3>& p) {
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) pairs.push_back({i, j});
  std::vector<Point3> out;
  const auto row = [&](const auto& pair) {
    const Point3 &a = p[pair[0]], &b = p[pair[1]];
    return Point3{a[0] - b[0], a[1] - b[1], 0.5 * (dot(a, a) - dot(b, b))};
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    out.push_back({0.5 * (p[pairs[i][0]][0] + p[pairs[i][1]][0]),
                   0.5 * (p[pairs[i][0]][1] + p[pairs[i][1]][1]), 0.0});
    for (std::size_t j = 0; j < i; ++j) {
      const Point3 a = row(pairs[i]), b = row(pairs[j]);
      const double det = a[0] * b[1] - a[1] * b[0];
      if (std::abs(det) < 1e-12) continue;
      out.push_back({(a[2] * b[1] - a[1] * b[2]) / det, (a[0] * b[2] - a[2] * b[0]) / det, 0.0});
    }
  }
  return out;
}

TEST(AssociationLaw, CircleOfThePlaneIsTheBestOfAll) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    std::vector<Point3> points;  // form errors of up to a tenth of the radius
    for (int i = 0; i < 12; ++i) {
      const double t = pi / 6.0 * (i + draw.uniform(-0.3, 0.3)), r = draw.uniform(9.5, 10.5);
      points.push_back({r * std::cos(t), r * std::sin(t), 0.0});
    }
    double zone = 1e300, outer = 1e300, inner = 0.0;
    for (const Point3& centre : centres_of(points)) {
      double low = 1e300, high = 0.0;
      for (const Point3& p : points) {
        const double r = std::hypot(p[0] - centre[0], p[1] - centre[1]);
        low = std::min(low, r), high = std::max(high, r);
      }
      zone = std::min(zone, high - low);
      outer = std::min(outer, high);
      if (norm(centre) < 5.0) inner = std::max(inner, low);  // inside the points
    }
    const auto radius = [&](Criterion criterion) {
      return associate(points, Element::circle, criterion).feature.radius_mm;
    };
    EXPECT_NEAR(associate(points, Element::circle, Criterion::minimum_zone).zone_mm, zone, 1e-11);
    EXPECT_NEAR(radius(Criterion::minimum_circumscribed), outer, 1e-11);
    EXPECT_NEAR(radius(Criterion::maximum_inscribed), inner, 1e-11);
  }
}

// All points of an arc below half a turn lie in the circle about the middle of its chord, and its
// ends are half a chord from there: none smaller holds both. It is far from the Gaussian circle.
TEST(AssociationLaw, TheCircleAboutAShortArcHasItsChordAsDiameter) {
  for (const double arc_deg : {0.8, 3.0, 10.0, 30.0, 120.0}) {
    SCOPED_TRACE(arc_deg);
    std::vector<Point3> points;
    constexpr int count = 60;
    for (int i = 0; i < count; ++i) {
      const double at = arc_deg * rad_per_deg * i / (count - 1.0);
      points.push_back({20.0 * std::cos(at), 20.0 * std::sin(at), 0.0});
    }
    const AssociatedFeature found =
        associate(points, Element::circle, Criterion::minimum_circumscribed);
    ASSERT_EQ(found.status, AssociationStatus::converged);
    EXPECT_NEAR(found.feature.radius_mm, 20.0 * std::sin(0.5 * arc_deg * rad_per_deg), 1e-9);
  }
}

TEST(AssociationLaw, LineOfThePlaneIsTheBestOfAll) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw(seed);
    std::vector<Point3> points;  // up to as wide as half as long
    const double wide = draw.uniform(0.01, 5.0);
    for (int i = 0; i < 12; ++i)
      points.push_back({draw.uniform(-10.0, 10.0), draw.uniform(-wide, wide), 0.0});
    double zone = 1e300;  // a strip rests on two points on one side
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double x = points[i][0] - points[j][0], y = points[i][1] - points[j][1];
        double low = 1e300, high = -1e300;
        for (const Point3& p : points) {
          const double d = (x * p[1] - y * p[0]) / std::hypot(x, y);
          low = std::min(low, d), high = std::max(high, d);
        }
        zone = std::min(zone, high - low);
      }
    }
    EXPECT_NEAR(associate(points, Element::line, Criterion::minimum_zone).zone_mm, zone, 1e-11);
  }
}

TEST(AssociationLaw, TheSameBytesAtAnyNumberOfThreads) {
  Draw draw(31);
  const auto points = points_on(Element::cylinder, 100000, 0.01, draw);
  for (const Criterion criterion : {Criterion::gaussian, Criterion::minimum_zone}) {
    const auto one = associate(points, Element::cylinder, criterion, {.threads = 1});
    const auto four = associate(points, Element::cylinder, criterion, {.threads = 4});
    EXPECT_EQ(one.feature.point_mm, four.feature.point_mm);
    EXPECT_EQ(one.feature.direction, four.feature.direction);
    EXPECT_EQ(one.zone_mm, four.zone_mm);
    EXPECT_EQ(one.iterations, four.iterations);
  }
}

TEST(AssociationLaw, TheUncertaintyCoversTheTruth) {
  // 200 repeats of |z| ≤ 2 for a normal deviate: 0.954 ± 3 √(0.954 · 0.046 / 200) = 0.91 … 1.
  int points = 0, directions = 0, angles = 0;
  constexpr int repeats = 200;
  for (unsigned seed = 1; seed <= repeats; ++seed) {
    Draw draw(seed);
    std::normal_distribution<double> noise(0.0, 0.01);
    std::vector<Point3> cone;
    for (int i = 0; i < 80; ++i) {
      const double t = draw.uniform(0.0, 1.5 * pi), z = draw.uniform(-10.0, 10.0);
      const double d = noise(draw.engine()), a = std::atan(0.4);
      const double r = 10.0 + 0.4 * z + d * std::cos(a);
      cone.push_back({r * std::cos(t), r * std::sin(t), z - d * std::sin(a)});
    }
    const auto got = associate(cone, Element::cone, Criterion::gaussian);
    const Feature &f = got.feature, &u = got.u;
    // The axis is the z axis, the radius 10 at z = 0: at the point of the result it is with its z.
    points += std::abs(f.point_mm[0]) <= 2.0 * u.point_mm[0];
    directions += std::abs(f.direction[1]) <= 2.0 * u.direction[1];
    angles += std::abs(f.half_angle_rad - std::atan(0.4)) <= 2.0 * u.half_angle_rad;
  }
  for (const int covered : {points, directions, angles}) {
    EXPECT_GE(covered, 0.91 * repeats);
    EXPECT_LT(covered, repeats);
  }
}

}  // namespace
}  // namespace trueaxis
