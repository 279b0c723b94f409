// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "associate/files/association_files.hpp"
#include "interchange/qif.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::array<QifFeatureKind, element_names.size()> kinds{
    QifFeatureKind::line,     QifFeatureKind::circle, QifFeatureKind::plane, QifFeatureKind::sphere,
    QifFeatureKind::cylinder, QifFeatureKind::cone,   QifFeatureKind::torus};

/// QIF has no name for the last one.
constexpr std::array<const char*, criterion_names.size()> algorithms{
    "LEASTSQUARES", "MINMAX", "MINCIRCUMSCRIBED", "MAXINSCRIBED",
    "least squares, outside of the material"};

QifValue scaled(double value, double u, double factor) { return {factor * value, factor * u}; }

/// QIF has the point of a line and of a cylinder where it begins, with its length: the least and
/// the largest of the points along the direction. u there is at most that of the point and of the
/// direction added up.
void begin_at_end(QifFeature& out, const Feature& feature, const std::vector<Point3>& points_mm) {
  double low = 1e300, high = -1e300;
  for (const Point3& point : points_mm) {
    double along = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      along += (point[i] - feature.point_mm[i]) * feature.direction[i];
    low = std::min(low, along);
    high = std::max(high, along);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    out.point_mm->value[i] += low * out.direction->value[i];
    out.point_mm->u[i] += std::abs(low) * out.direction->u[i];
  }
  out.length_mm = QifValue{high - low};
}

QifFeature feature_of(const AssociatedFeature& of, const PointText& points) {
  const Feature &feature = of.feature, &u = of.u;
  const std::string element = element_names[static_cast<std::size_t>(of.element)];
  QifFeature out{.kind = kinds[static_cast<std::size_t>(of.element)],
                 .name = element,
                 .algorithm = algorithms[static_cast<std::size_t>(of.criterion)],
                 .point_mm = QifVector{.value = feature.point_mm, .u = u.point_mm}};
  if (of.element != Element::sphere)
    out.direction = QifVector{.value = feature.direction, .u = u.direction};
  if (of.element == Element::line || of.element == Element::cylinder)
    begin_at_end(out, feature, points.points_mm);
  if (std::isfinite(feature.radius_mm))
    out.diameter_mm = scaled(feature.radius_mm, u.radius_mm, 2.0);
  if (std::isfinite(feature.minor_radius_mm))
    out.minor_diameter_mm = scaled(feature.minor_radius_mm, u.minor_radius_mm, 2.0);
  if (std::isfinite(feature.half_angle_rad))
    out.half_angle_deg = scaled(feature.half_angle_rad, u.half_angle_rad, 1.0 / rad_per_deg);
  const bool tube = of.element == Element::circle && !of.in_plane;  // no roundness
  if (!tube) out.form_mm = QifValue{of.zone_mm};
  return out;
}

}  // namespace

std::string association_qif(const AssociatedFeature& of, const PointText& points) {
  const std::string description = fmt::format(
      "Association of {} points of {} ({}), {}. combinedUncertainty is the standard uncertainty u. "
      "Form is the width of the zone that holds the points.",
      of.points, points.source, points.hash,
      criterion_names[static_cast<std::size_t>(of.criterion)]);
  return qif_document({.description = description, .features = {feature_of(of, points)}},
                      TRUEAXIS_VERSION);
}

}  // namespace trueaxis
