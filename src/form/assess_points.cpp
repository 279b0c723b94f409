// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/counted.hpp"
#include "form/axis_line.hpp"
#include "form/face.hpp"
#include "form/notes.hpp"
#include "form/point_noise.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/form.hpp"

namespace trueaxis {
namespace form {
namespace {

constexpr double between_slices_mm = 0.05;
constexpr double thickest_slice_mm = 0.5;

using Points = std::span<const Point3>;

/// Every place once, in order: a point that is written again is not another reading.
std::vector<Point3> once(Points points) {
  std::vector<Point3> out;
  std::set<Point3> known;
  for (const Point3& one : points)
    if (known.insert(one).second) out.push_back(one);
  return out;
}

void note_again(std::size_t again, FormResult& result) {
  if (again > 0)
    result.notes.push_back(
        fmt::format("{} to the last digit and counts once",
                    counted(again, "point repeats another", "points repeat others")));
}

void expect_finite(Points points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double one : points[i])
      if (!std::isfinite(one))
        throw InputError("points", fmt::format("point {} is not finite", i + 1));
}

/// The element by least squares: where values are to be looked for.
AssociatedFeature nominal(Points points, Element element) {
  AssociatedFeature found = associate(points, element, Criterion::gaussian);
  if (found.status != AssociationStatus::converged) throw InputError("points", found.why);
  return found;
}

/// Coordinates about the point of an element: third one along its direction.
std::vector<Eigen::Vector3d> in_frame(Points points, const AssociatedFeature& found) {
  const Point3& p = found.feature.point_mm;
  const Eigen::Vector3d origin(p[0], p[1], p[2]);
  Eigen::Matrix3d part_from_points = Eigen::Matrix3d::Identity();
  const Point3& d = found.feature.direction;
  if (!found.in_plane) {
    const Eigen::Vector3d along(d[0], d[1], d[2]);
    const Eigen::Vector3d across =
        along.cross(std::abs(along.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY())
            .normalized();
    part_from_points << across.transpose(), along.cross(across).transpose(), along.transpose();
  } else if (found.element == Element::line) {
    part_from_points << -d[1], d[0], 0.0, 0.0, 0.0, 1.0, d[0], d[1], 0.0;
  }
  std::vector<Eigen::Vector3d> out;
  for (const Point3& one : points)
    out.push_back(part_from_points * (Eigen::Vector3d(one[0], one[1], one[2]) - origin));
  return out;
}

/// Places along the axis made those of their sections. @throws InputError where there are none
std::vector<double> sections_along(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return points[i].z(); });
  std::vector<double> out(points.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() &&
           points[order[end]].z() - points[order[end - 1]].z() <= between_slices_mm)
      ++end;
    const double low = points[order[begin]].z(), high = points[order[end - 1]].z();
    if (high - low > thickest_slice_mm)
      throw InputError("points",
                       fmt::format("the points of the cylinder are not in sections (some from "
                                   "{:.4g} to {:.4g} mm along the axis without a break): `trueaxis "
                                   "fit --points` gives the zone of such points, without a filter",
                                   low, high));
    for (std::size_t k = begin; k < end; ++k) out[order[k]] = 0.5 * (low + high);
    begin = end;
  }
  return out;
}

ProbeStream as_stream(const std::vector<Eigen::Vector3d>& points, bool cylinder) {
  ProbeStream stream;
  stream.source = "points";
  for (const Eigen::Vector3d& one : points) {
    stream.c_rad.push_back(std::atan2(one.y(), one.x()));
    stream.reading_mm.push_back(std::hypot(one.x(), one.y()));
  }
  if (cylinder) stream.position_mm = sections_along(points);
  return stream;
}

FormResult revolved(const std::vector<Eigen::Vector3d>& points, Element element,
                    const FormOptions& options) {
  const ProbeStream stream = as_stream(points, element == Element::cylinder);
  const auto [low, high] = std::ranges::minmax(stream.reading_mm);
  if (high - low > 0.5 * high)
    throw InputError(
        "points",
        fmt::format("the points do not form a {}: they are {:.4g} to {:.4g} mm from its centre",
                    element_names[static_cast<std::size_t>(element)], low, high));
  FormResult result = assess_form(stream, options);
  // Points know no spindle: there is nothing to be eccentric to.
  std::erase_if(result.groups, [](const FormGroup& group) { return group.name == "datum"; });
  for (SectionForm& section : result.sections)
    std::erase_if(section.values, [](const FormValue& one) { return one.name == "eccentricity"; });
  result.notes.emplace_back(
      element == Element::circle
          ? "Centres are against that of the least-squares circle, angles from its first axis"
          : "Centres and Z are against the least-squares cylinder of all points");
  return result;
}

FormResult heights(const std::vector<Eigen::Vector3d>& points, bool plane,
                   const FormOptions& options) {
  FormResult result;
  result.options = options;
  std::vector<std::array<double, 2>> at;
  std::vector<double> height;
  for (const Eigen::Vector3d& one : points) {
    at.push_back(plane ? std::array{one.x(), one.y()} : std::array{one.z(), 0.0});
    height.push_back(plane ? one.z() : one.x());
  }
  assess_heights(
      at, plane, height,
      [&](std::span<const double> off) { return noise_of_points_mm(at, plane, off); }, {}, {},
      false, result);
  return result;
}

/// A line in space: the diameter of the least cylinder that holds its points.
FormResult space_line(const std::vector<Eigen::Vector3d>& points, const FormOptions& options) {
  FormResult result;
  result.options = options;
  std::vector<double> across;
  for (const Eigen::Vector3d& one : points) {
    across.push_back(one.x());
    across.push_back(one.y());
  }
  const AssessHeights assess = [&](std::span<const double> moved) {
    std::vector<CentrePoint> centres;
    for (std::size_t i = 0; i < points.size(); ++i)
      centres.push_back({moved[2 * i], moved[2 * i + 1], points[i].z()});
    return std::vector<NamedValue>{{"straightness", "STRt", "MZLI", smallest_cylinder_mm(centres)}};
  };
  const double noise_mm = options.noise_mm.value_or(0.0);
  const auto spread = spreads_of_heights(across, across, noise_mm, options, assess);
  Estimate value{assess(across).front().value, spread[0].u, "mm", ""};
  if (!options.noise_mm) {
    value.u = std::nan("");
    value.why_not = "the noise of a point is not stated (--noise-um)";
  }
  result.groups.push_back({"straightness", {{"STRt", "MZLI", value, spread[0].bias}}});
  return result;
}

}  // namespace
}  // namespace form

FormResult assess_form(std::span<const Point3> written_mm, Element element,
                       const FormOptions& options) {
  using namespace form;
  expect_options(options);
  if (element != Element::line && element != Element::circle && element != Element::plane &&
      element != Element::cylinder)
    throw InputError("points", fmt::format("ISO 1101 does not define form parameters of a {}: use "
                                           "`trueaxis fit --points` for its zone",
                                           element_names[static_cast<std::size_t>(element)]));
  expect_finite(written_mm);
  const std::vector<Point3> points_mm = once(written_mm);
  const AssociatedFeature found = nominal(points_mm, element);
  const std::vector<Eigen::Vector3d> points = in_frame(points_mm, found);
  FormResult result = element == Element::circle || element == Element::cylinder
                          ? revolved(points, element, options)
                      : element == Element::line && !found.in_plane
                          ? space_line(points, options)
                          : heights(points, element == Element::plane, options);
  note_again(written_mm.size() - points_mm.size(), result);
  return result;
}

}  // namespace trueaxis
