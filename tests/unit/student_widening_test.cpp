// SPDX-License-Identifier: Apache-2.0
// U = k u where few readings show σ (JCGM 100, G.3): Student's t, as tabulated and as it covers.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/statistics.hpp"
#include "trueaxis/association.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::student_widening_test {
namespace {

// Table G.2 of JCGM 100, for 95.45 % and 68.27 %, to its two decimals.
TEST(StudentWidening, IsTheTableOfTheGum) {
  struct Row {
    double freedom, of_two, of_one;
  };
  for (const Row& row : {Row{1, 13.97, 1.84}, Row{2, 4.53, 1.32}, Row{5, 2.65, 1.11},
                         Row{10, 2.28, 1.05}, Row{50, 2.05, 1.01}}) {
    EXPECT_NEAR(2.0 * student_widening(row.freedom, 2.0), row.of_two, 0.006) << row.freedom;
    EXPECT_NEAR(student_widening(row.freedom, 1.0), row.of_one, 0.006) << row.freedom;
  }
  EXPECT_EQ(student_widening(1000.0, 2.0), 1.0);
  EXPECT_NEAR(student_widening(999.0, 2.0), 1.0, 2e-3);
}

constexpr int trials = 1500;
constexpr double noise_mm = 2e-3;

/// 95.45 % of the trials within four standard deviations of a binomial: 2.2 %.
void expect_covers(int inside, const char* what) {
  const double p = std::erf(std::sqrt(2.0));
  EXPECT_NEAR(static_cast<double>(inside) / trials, p, 4.0 * std::sqrt(p * (1.0 - p) / trials))
      << what;
}

/// A section of as many readings, about (0.05, −0.03), of radius 20.
ProbeStream section(int readings, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, noise_mm);
  ProbeStream stream;
  for (int i = 0; i < readings; ++i) {
    const double c = two_pi * i / readings, along = 0.05 * std::cos(c) - 0.03 * std::sin(c);
    const double across = 0.05 * std::sin(c) + 0.03 * std::cos(c);
    stream.c_rad.push_back(c);
    stream.reading_mm.push_back(along + std::sqrt(400.0 - across * across) + noise(random));
  }
  return stream;
}

// Without the widening 2 u of a section of 5 readings held 82 %, of a plane of 4 points 70 %.
TEST(StudentWidening, UOfAFitCovers) {
  std::mt19937_64 random(21);
  FitOptions options;
  options.surface = SurfaceKind::section;
  for (const int readings : {5, 12}) {
    int x = 0, radius = 0;
    for (int i = 0; i < trials; ++i) {
      const FitResult result = fit(section(readings, random), options);
      ASSERT_EQ(result.status, FitStatus::converged) << result.message;
      x += std::abs(result.parameter("x0").value - 0.05) <= 2.0 * result.parameter("x0").u;
      const Estimate& r = result.parameter("radius");
      radius += std::abs(r.value - 20.0) <= 2.0 * r.u;
    }
    expect_covers(x, "x0");
    expect_covers(radius, "radius");
  }
}

TEST(StudentWidening, NothingWhereTheNoiseIsStated) {
  std::mt19937_64 random(22);
  FitOptions options;
  options.surface = SurfaceKind::section;
  options.noise_mm = 10.0 * noise_mm;
  const FitResult result = fit(section(5, random), options);
  EXPECT_EQ(result.widened, 1.0);
  // σ/√N of a mean, in an expansion to e/R.
  EXPECT_NEAR(result.parameter("radius").u, 10.0 * noise_mm / std::sqrt(5.0), 1e-2 * noise_mm);
}

TEST(StudentWidening, UOfPointsCovers) {
  std::mt19937_64 random(23);
  std::normal_distribution<double> noise(0.0, noise_mm);
  std::uniform_real_distribution<double> place(0.0, 100.0);
  for (const std::size_t count : {4U, 5U, 30U}) {
    int z = 0;
    for (int i = 0; i < trials; ++i) {
      std::vector<Point3> points;
      while (points.size() < count) points.push_back({place(random), place(random), noise(random)});
      const AssociatedFeature of = associate(points, Element::plane, Criterion::gaussian);
      ASSERT_EQ(of.status, AssociationStatus::converged) << of.why;
      z += std::abs(of.feature.point_mm[2]) <= 2.0 * of.u.point_mm[2];
    }
    expect_covers(z, "z of a plane");
  }
  int radius = 0;
  for (int i = 0; i < trials; ++i) {
    std::vector<Point3> points;
    for (int k = 0; k < 8; ++k) {
      const double t = two_pi * k / 8.0 + 0.3 * (k % 2), r = 12.0 + noise(random);
      points.push_back({r * std::cos(t), r * std::sin(t), k % 2 == 0 ? 0.0 : 20.0});
    }
    const AssociatedFeature of = associate(points, Element::cylinder, Criterion::gaussian);
    ASSERT_EQ(of.status, AssociationStatus::converged) << of.why;
    radius += std::abs(of.feature.radius_mm - 12.0) <= 2.0 * of.u.radius_mm;
  }
  expect_covers(radius, "radius of a cylinder");
}

}  // namespace
}  // namespace trueaxis::student_widening_test
