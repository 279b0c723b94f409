// SPDX-License-Identifier: Apache-2.0
// Reference pairs: points and the element to 30 digits by tests/reference/make_association_pairs.py
// (mpmath, other parameters, derivatives by differences, optimality proven there).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/places.hpp"
#include "trueaxis/association.hpp"

namespace trueaxis {
namespace {

namespace fs = std::filesystem;
const fs::path folder = fs::path(places::source()) / "tests/reference/association";

std::vector<double> numbers_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<double> out;
  for (double value = 0.0; file >> value;) out.push_back(value);
  return out;
}

std::vector<Point3> points_of(const std::string& name) {
  const std::vector<double> numbers = numbers_of(folder / (name + ".ds"));
  std::vector<Point3> out;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    out.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return out;
}

/// An answer as a result: point, direction, sizes as the element has them, zone.
AssociatedFeature answer_of(Element element, Criterion criterion, const std::vector<double>& of,
                            bool in_plane) {
  AssociatedFeature out{.element = element, .criterion = criterion, .in_plane = in_plane};
  std::size_t at = 0;
  for (double& value : out.feature.point_mm) value = of.at(at++);
  if (element != Element::sphere)
    for (double& value : out.feature.direction) value = of.at(at++);
  if (element != Element::line && element != Element::plane) out.feature.radius_mm = of.at(at++);
  if (element == Element::cone) out.feature.half_angle_rad = of.at(at++);
  if (element == Element::torus) out.feature.minor_radius_mm = of.at(at++);
  out.zone_mm = of.at(at++);
  EXPECT_EQ(at, of.size());
  return out;
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// How far two elements are apart: points in mm (a shift along an axis or in a plane does not
/// count), directions in rad, sizes in mm, angles in rad.
struct Apart {
  double point = 0.0, direction = 0.0, radius = 0.0, angle = 0.0;
};
Apart apart(const AssociatedFeature& a, const AssociatedFeature& b) {
  Apart out;
  const Feature &f = a.feature, &g = b.feature;
  const bool has_axis = a.element != Element::sphere;
  const auto axis_of = [&](std::size_t i) { return has_axis ? g.direction[i % 3] : 0.0; };
  double along = 0.0, square = 0.0, across = 0.0, cross = 0.0;
  for (std::size_t i = 0; i < 3; ++i) along += (f.point_mm[i] - g.point_mm[i]) * axis_of(i);
  for (std::size_t i = 0; i < 3; ++i) {
    const double step = f.point_mm[i] - g.point_mm[i];
    square += step * step;
    across += std::pow(step - along * axis_of(i), 2);
    if (has_axis)
      cross += std::pow(
          f.direction[(i + 1) % 3] * axis_of(i + 2) - f.direction[(i + 2) % 3] * axis_of(i + 1), 2);
  }
  out.direction = std::sqrt(cross);
  const bool axis =
      a.element == Element::line || a.element == Element::cylinder || a.element == Element::cone;
  out.point = a.element == Element::plane ? std::abs(along) : std::sqrt(axis ? across : square);
  double radius = g.radius_mm;
  if (a.element == Element::cone) {
    radius += along * std::tan(g.half_angle_rad);
    out.angle = std::abs(f.half_angle_rad - g.half_angle_rad);
  }
  if (std::isfinite(radius)) out.radius = std::abs(f.radius_mm - radius);
  if (a.element == Element::torus)
    out.radius = std::max(out.radius, std::abs(f.minor_radius_mm - g.minor_radius_mm));
  return out;
}

Element element_of(const std::string& name) {
  const std::string word = name.substr(0, name.find('_'));
  for (std::size_t i = 0; i < element_names.size(); ++i)
    if (word == element_names[i]) return static_cast<Element>(i);
  throw std::logic_error("no element: " + name);
}

TEST(AssociationPairs, EveryAnswerIsReached) {
  std::size_t pairs = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".fit")) continue;
    ++pairs;
    SCOPED_TRACE(file);
    const std::string name = file.substr(0, file.find('.'));
    const std::string word = file.substr(name.size() + 1, file.size() - name.size() - 5);
    const auto at = std::ranges::find(criterion_names, word) - criterion_names.begin();
    const auto criterion = static_cast<Criterion>(at);
    const std::vector<Point3> points = points_of(name);
    const AssociatedFeature got = associate(points, element_of(name), criterion);
    const AssociatedFeature answer =
        answer_of(element_of(name), criterion, numbers_of(entry.path()), got.in_plane);
    ASSERT_EQ(got.status, AssociationStatus::converged) << got.why;
    // The last digit of a coordinate 10⁶ mm from zero is 1.2e-10 mm; the rest is the goal of 1e-9.
    const Apart off = apart(got, answer);
    EXPECT_LE(off.point, 1e-9);
    EXPECT_LE(off.direction, 1e-9);
    EXPECT_LE(off.radius, 1e-9);
    EXPECT_LE(off.angle, 1e-9);
    // The zone is flat where the element is best: it is good to the rounding of coordinates.
    EXPECT_NEAR(got.zone_mm, answer.zone_mm, 1e-9);
    if (criterion == Criterion::gaussian) {
      EXPECT_LE(got.rms_mm, rms_of(distances_mm(points, answer)) + 1e-10);
    }
    RecordProperty(file, std::to_string(off.point));
  }
  EXPECT_EQ(pairs, 46U);
}

}  // namespace
}  // namespace trueaxis
