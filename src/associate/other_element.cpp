// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "trueaxis/association.hpp"

namespace trueaxis {
namespace {

constexpr double least_mm = 0.01, share = 0.1;  // of the RMS, as of a stream that is a sphere's
// The largest form of a turned part is 0.14 mm RMS; large parts have more. Eq. 308.
constexpr double most_mm = 0.5, most_per_size = 1e-3;
constexpr std::size_t enough = 5000;  // points that tell another element
constexpr std::size_t fewest = 20;    // three times the parameters of a cone: fewer fit anything

/// Evenly chosen, all if there are few.
std::vector<Point3> some_of(std::span<const Point3> points_mm) {
  const std::size_t step = (points_mm.size() + enough - 1) / enough;
  std::vector<Point3> out;
  for (std::size_t i = 0; i < points_mm.size(); i += step) out.push_back(points_mm[i]);
  return out;
}

double half_size_mm(std::span<const Point3> points_mm) {
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::ranges::minmax_element(
        points_mm, {}, [axis](const Point3& point) { return point[axis]; });
    largest = std::max(largest, 0.5 * ((*high)[axis] - (*low)[axis]));
  }
  return largest;
}

}  // namespace

std::string of_other_element(std::span<const Point3> points_mm, const AssociatedFeature& found) {
  const bool surface = found.element != Element::line && found.element != Element::circle;
  if (!surface || found.status != AssociationStatus::converged || !(found.rms_mm > least_mm))
    return "";
  const char* name = element_names[static_cast<std::size_t>(found.element)];
  const std::string off =
      fmt::format("the points lie {:.3g} mm RMS off the {}", found.rms_mm, name);
  const std::vector<Point3> some = some_of(points_mm);
  for (const Element other : {Element::plane, Element::sphere, Element::cylinder, Element::cone}) {
    if (other == found.element || points_mm.size() < fewest) continue;
    const AssociatedFeature it = associate(some, other, Criterion::gaussian);
    if (it.status != AssociationStatus::converged || !(it.rms_mm < share * found.rms_mm)) continue;
    return fmt::format("{}, and {:.2g} mm off a {}: they are not those of a {}", off, it.rms_mm,
                       element_names[static_cast<std::size_t>(other)], name);
  }
  const double limit_mm = most_mm + most_per_size * half_size_mm(points_mm);
  if (!(found.rms_mm > limit_mm)) return "";
  return fmt::format(
      "{}, and no part of that size leaves more than {:.2g} mm: check unit, columns "
      "and element",
      off, limit_mm);
}

}  // namespace trueaxis
