// SPDX-License-Identifier: Apache-2.0
// Form of point clouds: no order of the points changes it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "form/point_noise.hpp"
#include "support/form_profiles.hpp"

namespace trueaxis::form_points_test {
namespace {

using namespace testing;

constexpr double sigma_mm = 0.3e-3;

/// 25 by 16 points over 60 by 40 mm, row after row, with waves of an amplitude and white noise.
std::vector<Point3> raster(double wave_mm, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_mm);
  std::vector<Point3> points;
  for (int row = 0; row < 16; ++row)
    for (int column = 0; column < 25; ++column) {
      const double x = -30.0 + 2.5 * column, y = -20.0 + 40.0 / 15.0 * row;
      points.push_back({x, y, wave_mm * std::sin(x / 9.0) * std::cos(y / 11.0) + noise(random)});
    }
  return points;
}

FormValue flatness(const std::vector<Point3>& points, const FormOptions& options = quick()) {
  return value_of(group_of(assess_form(points, Element::plane, options), "flatness"), "FLTt",
                  "MZPL");
}

// The same points in another order, or each written twice, are the same face: the values to the
// rounding of a sum. U comes from 400 draws in the order of the points, to 3.5 %; four of those.
TEST(FormPoints, AnyOrderGivesTheSame) {
  FormOptions options = quick();
  options.trials = 400;
  const std::vector<Point3> rows = raster(4e-3, 3);
  const FormValue as_written = flatness(rows, options);
  EXPECT_TRUE(as_written.estimate.determined());
  std::vector<Point3> shuffled = rows, doubled;
  std::ranges::shuffle(shuffled, std::mt19937_64(4));
  for (const Point3& one : rows) doubled.insert(doubled.end(), {one, one});
  for (const auto& other : {shuffled, doubled}) {
    const FormValue same = flatness(other, options);
    EXPECT_NEAR(same.estimate.value, as_written.estimate.value, 1e-9);
    EXPECT_NEAR(same.estimate.u, as_written.estimate.u, 0.2 * as_written.estimate.u);
  }
  const FormResult noted = assess_form(doubled, Element::plane, quick());
  EXPECT_TRUE(std::ranges::any_of(noted.notes, [](const std::string& note) {
    return note.starts_with("400 points repeat others to the last digit");
  }));
}

// 400 distances give σ to √(1/800) = 3.5 %; neighbours share their points, so that these count as a
// quarter as many: three times 7 %. Waves of 57 mm leave (2.5 mm/9 mm)³/6 of 4 µm to a surface of
// second degree, 14 nm.
TEST(FormPoints, TheNoiseIsThatOfTheHeights) {
  for (const double wave_mm : {0.0, 4e-3})
    for (const unsigned seed : {1U, 2U, 3U}) {
      std::vector<std::array<double, 2>> at;
      std::vector<double> height;
      for (const auto& [x, y, z] : raster(wave_mm, seed)) at.push_back({x, y}), height.push_back(z);
      EXPECT_NEAR(form::noise_of_points_mm(at, true, height), sigma_mm, 0.21 * sigma_mm)
          << wave_mm << " seed " << seed;
    }
}

// A surface of second degree has no noise, along a line and on a plane, however it lies. Too few
// points do not show any.
TEST(FormPoints, ASmoothSurfaceHasNoNoise) {
  std::vector<std::array<double, 2>> at, along;
  std::vector<double> height, on_line;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  for (int i = 0; i < 60; ++i) {
    const double u = place(random), v = place(random);
    at.push_back({u, v}), height.push_back(1e-5 * u * u - 2e-5 * u * v + 1e-3 * v);
    along.push_back({u, 0.0}), on_line.push_back(3e-5 * u * u - 1e-3 * u);
  }
  EXPECT_NEAR(form::noise_of_points_mm(at, true, height), 0.0, 1e-12);
  EXPECT_NEAR(form::noise_of_points_mm(along, false, on_line), 0.0, 1e-12);
  EXPECT_EQ(form::noise_of_points_mm(std::span(at).first(3), true, std::span(height).first(3)),
            0.0);
}

}  // namespace
}  // namespace trueaxis::form_points_test
